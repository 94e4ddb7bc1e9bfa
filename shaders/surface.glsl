// What the lighting passes around. Every member has the precision of its term. Positions and
// vectors are in the space of the lighting: world or view (shaders/space/).

struct Surface {                // a point that is lit
    P_POSITION vec3 position;
    P_VECTOR vec3 normal;       // unit length, unless normalise=off
    P_VECTOR vec3 view;         // unit length, towards the eye; read it through view_of()
    P_SPECULAR float shininess;
};

struct Incident {               // one light as it arrives there
    P_VECTOR vec3 direction;    // unit length, towards the light; zero on the light itself
    P_VECTOR vec3 highlight;    // as direction, to where highlights come from: area lights only
                                // have another
    P_ATTENUATION float factor; // attenuation times cone
    P_ATTENUATION float shown;  // share that no shadow takes; ambient light has no shadow
    P_COLOR vec3 ambient;
    P_COLOR vec3 diffuse;
    P_COLOR vec3 specular;
};

struct Lit {                    // sums over the lights, without the material
    P_SUM vec3 ambient;
    P_SUM vec3 diffuse;
    P_SUM vec3 specular;
};

struct Shade {                  // light that leaves the surface
    P_SUM vec3 diffuse;         // ambient light too: the diffuse map is the surface's colour
    P_SUM vec3 specular;
};

// Unit vector to the eye: made once, or with hoist=per_light again by each light (lights/add.glsl).
P_VECTOR vec3 view_of(Surface surface);
