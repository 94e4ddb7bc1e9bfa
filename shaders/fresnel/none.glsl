// fresnel=none: the surface reflects its specular colour, whatever the angle. All of the
// lights' sum has it.
#define REFLECTED u_material.specular
