struct Material {
    P_UNIFORM vec3 ambient;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM vec3 specular;
    P_UNIFORM float shininess;
};
