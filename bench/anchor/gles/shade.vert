#version 300 es
#define GLSL_FAMILY es300
#define PROBE off
#define GIVEN interpolated
#define ROW_POINTS_ACROSS 256
#define SLIPS none
#define IF_AMBIENT(code) code
#define WITH_AMBIENT(code) code
#define IF_DIFFUSE(code) code
#define WITH_DIFFUSE(code) code
#define IF_SPECULAR(code) code
#define WITH_SPECULAR(code) code
#define IF_FRESNEL(code)
#define WITH_FRESNEL(code)
#define IF_SPECULAR_NORM(code)
#define WITH_SPECULAR_NORM(code)
#define IF_VIEW(code) code
#define WITH_VIEW(code) code
#define IF_VIEW_EACH(code)
#define WITH_VIEW_EACH(code)
#define IF_ATTENUATION(code) code
#define WITH_ATTENUATION(code) code
#define IF_LINEAR(code) code
#define WITH_LINEAR(code) code
#define IF_QUADRATIC(code) code
#define WITH_QUADRATIC(code) code
#define IF_CONE(code)
#define WITH_CONE(code)
#define IF_DIFFUSE_MAP(code)
#define WITH_DIFFUSE_MAP(code)
#define IF_DIFFUSE_MAP_EACH(code)
#define WITH_DIFFUSE_MAP_EACH(code)
#define IF_SPECULAR_MAP(code)
#define WITH_SPECULAR_MAP(code)
#define IF_SPECULAR_MAP_EACH(code)
#define WITH_SPECULAR_MAP_EACH(code)
#define IF_NORMAL_MAP(code)
#define WITH_NORMAL_MAP(code)
#define IF_RENORMALISE(code) code
#define WITH_RENORMALISE(code) code
#define IF_NARROW_OUTPUT(code)
#define WITH_NARROW_OUTPUT(code)
#define IF_TINTED(code)
#define WITH_TINTED(code)
#define CASTERS fixed
#define MAX_DIR_LIGHTS 0
#define MAX_POINT_LIGHTS 8
#define MAX_SPOT_LIGHTS 0
#define MAX_AREA_LIGHTS 0
#define MAX_LIGHTS 8
#define NR_LIGHTS 8
#define NR_DIR_LIGHTS 0
#define NR_POINT_LIGHTS 8
#define NR_SPOT_LIGHTS 0
#define NR_AREA_LIGHTS 0
#define AREA_SHAPE sphere
#define MODEL blinn
#define AMBIENT scene
#define ATTENUATION polynomial
#define CONE smooth
#define SPECULAR_SIDE front
#define MAPS none
#define NR_SHADOWS 0
#define FRESNEL none
#define SPECULAR_NORM none
#define STAGE fragment
#define P_POSITION highp
#define P_VECTOR highp
#define P_ATTENUATION highp
#define P_SPECULAR highp
#define P_COLOR highp
#define P_SUM highp
#define P_OUTPUT highp
#define P_VARYING highp
#define P_UNIFORM highp
#define P_SAMPLER highp
#define NORMALISE on
#define NORMAL_STORE rgb
#define F_UNIT robust
#define F_ATTENUATION robust
#define F_CONE robust
#define F_HIGHLIGHT robust
#define F_AREA robust
#define F_FRAME robust
#define F_OUTPUT robust
#define F_SHADOW robust
#define SHADOW_SIZE 512
#define SHADOW_BIAS 0.01
#define SHADOW_BIAS_KIND constant
#define SHADOW_FILTER 1
#define SHADOW_STORE r32f
#define LAYOUT split
#define STORAGE constant
#define LOOP constant
#define CAPACITY 0
#define HOIST once
#define SPACE world
#define GUARD branch
#define SHADOW_MAP cube
#define SHADOW_PASS faces
// Vertex shader of the program "shade": puts the geometry in its place and hands the surface
// to the stage that lights it. The geometry is highp in every variant: not it is on trial, and
// every variant covers the same pixels.
// GLSL ES 3.00 and newer.
#if __VERSION__ >= 310 && NR_SHADOWS > 0
#if defined(GL_EXT_texture_cube_map_array)
#extension GL_EXT_texture_cube_map_array : enable
#elif defined(GL_OES_texture_cube_map_array)
#extension GL_OES_texture_cube_map_array : enable
#endif
#if defined(GL_EXT_geometry_shader)
#extension GL_EXT_geometry_shader : enable
#elif defined(GL_OES_geometry_shader)
#extension GL_OES_geometry_shader : enable
#endif
#endif
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D P_SAMPLER sampler2D
#define SAMPLER(precision, type) precision type
#define TEXTURE texture
#define DECLARE_O_COLOR layout(location = 0) out P_OUTPUT vec4 o_color;
// GIVEN=interpolated: what a point is lit by comes from the rasteriser, uniforms and textures.
#define GIVEN_INPUT VARYING_IN
#define GIVEN_UNIFORM uniform
#define GIVEN_MAP(name) uniform SAMPLER2D name;

ATTRIBUTE highp vec3 a_position;
ATTRIBUTE highp vec3 a_normal;
ATTRIBUTE highp vec2 a_uv;
ATTRIBUTE highp vec4 a_tangent; // w: sign of the bitangent

uniform highp mat4 u_model;
uniform highp mat3 u_normal_matrix; // to the space of the lighting
uniform highp mat4 u_view_projection;

VARYING_OUT P_VARYING vec2 v_uv; // the linker drops it where no map reads it

// space=world: what the vertex shader hands to the lighting.
highp vec3 lit_position(highp vec4 world)
{
    return world.xyz;
}

highp vec3 lit_direction(highp vec3 world)
{
    return world;
}
// stage=fragment: what the lighting needs is interpolated (Phong 1975).
VARYING_OUT P_VARYING vec3 v_position;
VARYING_OUT P_VARYING vec3 v_normal;
WITH_NORMAL_MAP(VARYING_OUT P_VARYING vec3 v_tangent;)
WITH_NORMAL_MAP(VARYING_OUT P_VARYING vec3 v_bitangent;)

void hand_over(highp vec3 position, highp vec3 normal)
{
    v_position = position;
    v_normal = normal;
}

void hand_over_frame(highp vec3 normal, highp vec3 tangent)
{
    IF_NORMAL_MAP(v_tangent = tangent;)
    IF_NORMAL_MAP(v_bitangent = cross(normal, tangent) * a_tangent.w;)
}
// The unit normal of a vertex, highp in every variant.
// Which of its two forms a formula has: the robust one is guarded and free of avoidable
// cancellation, the naive one is what textbooks print. Both stand in one file, and one of them
// takes the plain name. A formula with one form has the plain name too, so callers know of
// neither.
#define unit                 unit_robust
#define unit_difference      unit_difference_robust
#define vertex_normal        vertex_normal_robust
#define attenuation          attenuation_robust
#define cone                 cone_robust
#define specular_factor      specular_factor_robust
#define half_vector          half_vector_robust
#define schlick              schlick_robust
#define ball_nearest         ball_nearest_robust
#define ball_nearest_ray     ball_nearest_ray_robust
#define segment_nearest      segment_nearest_robust
#define segment_nearest_ray  segment_nearest_ray_robust
#define decoded_normal       decoded_normal_robust
#define restored_normal      restored_normal_robust
#define normal_in_frame      normal_in_frame_robust
#define output_colour        output_colour_robust
#define shadow_stored        shadow_stored_robust
#define shadow_face          shadow_face_robust
#define shadow_share         shadow_share_robust

// A zero normal (the tip of a cone, a collapsed triangle) stays zero, and so unlit, where
// normalize() gives NaN and blackens every triangle around the vertex.
highp vec3 vertex_normal_robust(highp vec3 normal)
{
    highp float n2 = dot(normal, normal);
    return n2 > 0.0 ? normal * inversesqrt(n2) : normal;
}

highp vec3 vertex_normal_naive(highp vec3 normal)
{
    return normalize(normal);
}

void main()
{
    highp vec4 world = u_model * vec4(a_position, 1.0);
    gl_Position = u_view_projection * world;
    v_uv = a_uv;

    highp vec3 normal = vertex_normal(u_normal_matrix * a_normal);
    hand_over(lit_position(world), normal);
    IF_NORMAL_MAP(hand_over_frame(normal, lit_direction(mat3(u_model) * a_tangent.xyz));)
}
