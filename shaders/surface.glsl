// What the lighting passes around. Every member has the precision of its term.

struct Surface {                // a point that is lit, world space
    P_POSITION vec3 position;
    P_VECTOR vec3 normal;       // unit length, unless normalise=off
    P_VECTOR vec3 view;         // unit length, towards the eye
    P_SPECULAR float shininess;
};

struct Incident {               // one light as it arrives there
    P_VECTOR vec3 direction;    // unit length, towards the light; zero on the light itself
    P_ATTENUATION float factor; // attenuation times cone
    P_COLOR vec3 ambient;
    P_COLOR vec3 diffuse;
    P_COLOR vec3 specular;
};

struct Lit {                    // sums over the lights, without the material
    P_SUM vec3 ambient;
    P_SUM vec3 diffuse;
    P_SUM vec3 specular;
};

struct Shade {                  // light that leaves the surface, without the maps
    P_SUM vec3 diffuse;         // ambient light too: the diffuse map is the surface's colour
    P_SUM vec3 specular;
};
