// The lights as they are uploaded: members in the order of the C structs in
// src/scene/lights.h, so that std140 gives the C layout. A float behind a vec3 shares its 16
// bytes; where C has padding, std140 aligns the next vec3 by itself (OpenGL 4.6 core, 7.6.2.2).

struct DirLight {
    P_UNIFORM vec3 direction; // the way the light travels
    P_UNIFORM vec3 ambient;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM vec3 specular;
};

struct PointLight {
    P_UNIFORM vec3 position;
    P_UNIFORM float range;
    P_UNIFORM vec3 ambient;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
};

struct SpotLight {
    P_UNIFORM vec3 position;
    P_UNIFORM float range;
    P_UNIFORM vec3 ambient;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
    P_UNIFORM vec3 direction; // the way the cone points, unit length
    P_UNIFORM float cos_cutoff;
    P_UNIFORM float exponent;
    P_UNIFORM float inv_one_minus_cos;
    P_UNIFORM float cone_scale;
    P_UNIFORM float cone_offset;
};
