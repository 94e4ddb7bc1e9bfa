// GLSL ES 1.00: attribute and varying, and an output that has no declaration (and is mediump,
// whatever P_OUTPUT says: GLSL ES 1.00, 7.2).
//
// No default precision for floats, in any version: a declaration that forgets its own does not
// compile in a GLES fragment shader, so no term can have a precision that nobody asked for.
#define ATTRIBUTE attribute
#define VARYING_OUT varying
#define VARYING_IN varying
#define SAMPLER2D P_SAMPLER sampler2D
#define TEXTURE texture2D
#define DECLARE_O_COLOR
#define o_color gl_FragColor
