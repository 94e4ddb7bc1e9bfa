#version 330 core
#define GLSL_FAMILY gl
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
// Fragment shader of the program "shade": light that leaves the surface, times the maps that
// the lights have not applied already (hoist).
// Desktop GLSL, 3.30 and newer. Precision qualifiers are taken there and mean nothing (GLSL 4.60,
// 4.7); on samplers 3.30 does not have them.
#if __VERSION__ < 400 && NR_SHADOWS > 0
#ifdef GL_ARB_texture_cube_map_array
#extension GL_ARB_texture_cube_map_array : enable
#endif
#endif
#define ATTRIBUTE in
#define VARYING_OUT out
#define VARYING_IN in
#define SAMPLER2D sampler2D
#define SAMPLER(precision, type) type
#define TEXTURE texture
#define DECLARE_O_COLOR layout(location = 0) out P_OUTPUT vec4 o_color;
// GIVEN=interpolated: what a point is lit by comes from the rasteriser, uniforms and textures.
#define GIVEN_INPUT VARYING_IN
#define GIVEN_UNIFORM uniform
#define GIVEN_MAP(name) uniform SAMPLER2D name;

GIVEN_INPUT P_VARYING vec2 v_uv;
DECLARE_O_COLOR

// PROBE=off, in fragment shaders of either stage: nothing is told of the maps.
#define PROBE_MAP(number, texel)
#define PROBE_PIXEL_OUT
// maps=none.
// stage=fragment: lit here.
GIVEN_INPUT P_VARYING vec3 v_position;
GIVEN_INPUT P_VARYING vec3 v_normal;
WITH_NORMAL_MAP(GIVEN_INPUT P_VARYING vec3 v_tangent;)
WITH_NORMAL_MAP(GIVEN_INPUT P_VARYING vec3 v_bitangent;)

// Unit vectors. Of a difference of positions: its square leaves the range of half floats at a
// distance of 256, so it is squared in the precision of positions.
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

// A zero vector stays zero, and so lights nothing: normalize(0) is 0 * infinity, a NaN. A
// select, not max(length, tiny): it is exact at every scale of the scene and needs no constant
// that would have to be a normal number in half precision too.
P_VECTOR vec3 unit_robust(P_VECTOR vec3 v)
{
    P_VECTOR float v2 = dot(v, v);
    return v2 > 0.0 ? v * inversesqrt(v2) : v;
}

P_VECTOR vec3 unit_difference_robust(P_POSITION vec3 d)
{
    P_POSITION float d2 = dot(d, d);
    return d2 > 0.0 ? d * inversesqrt(d2) : d;
}

P_VECTOR vec3 unit_naive(P_VECTOR vec3 v)
{
    return normalize(v);
}

P_VECTOR vec3 unit_difference_naive(P_POSITION vec3 d)
{
    return normalize(d);
}
// normalise=on: interpolation shortens a normal (by cos of half the angle between its ends), unless
// all vertices of a triangle have the same.
P_VECTOR vec3 surface_normal(P_VECTOR vec3 interpolated)
{
    P_VECTOR vec3 normal = interpolated;
    IF_RENORMALISE(normal = unit(normal);)
    return normal;
}
// The lighting of one point, the same text in the vertex and in the fragment shader:
//   shade.diffuse  = material.ambient * ambient + material.diffuse * sum(diffuse)
//   shade.specular = material.specular * sum(specular)
// docs/glsl.md has the whole equation.
// PROBE=off: nothing is told, and the driver sees nothing of it.
// The macros of what comes of the lights, where nothing of it is told.
#define PROBE_TERM(place, value)
#define PROBE_RAW(place, value)
#define PROBE_DIRECTION(value)
#define PROBE_NORMAL(value)
#define PROBE_VIEW(value)
#define PROBE_DECIDED(outcome) (outcome)
#define PROBE_SIDE(outcome)
#define PROBE_SHOWN(share)
#define PROBE_NEXT_LIGHT

#define PROBE_INPUTS(position, normal, uv)
#define PROBE_FRAME(tangent, bitangent)
#define PROBE_OUT
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

// What there is to read.
struct DirLight {
    P_UNIFORM vec3 direction;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM vec3 specular;
};
#define DIR_LIGHT_OF(light) DirLight(light.direction, light.diffuse, light.specular)
struct PointLight {
    P_UNIFORM vec3 position;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
};
#define POINT_LIGHT_OF(light) PointLight(light.position, light.constant, light.diffuse, light.linear, light.specular, light.quadratic)
struct SpotLight {
    P_UNIFORM vec3 position;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
    P_UNIFORM vec3 direction;
    P_UNIFORM float cone_scale;
    P_UNIFORM float cone_offset;
};
#define SPOT_LIGHT_OF(light) SpotLight(light.position, light.constant, light.diffuse, light.linear, light.specular, light.quadratic, light.direction, light.cone_scale, light.cone_offset)
struct AreaLight {
    P_UNIFORM vec3 position;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
    P_UNIFORM float radius;
};
#define AREA_LIGHT_OF(light) AreaLight(light.position, light.constant, light.diffuse, light.linear, light.specular, light.quadratic, light.radius)
struct Light {
    P_UNIFORM vec3 position;
    P_UNIFORM float w;
    P_UNIFORM float constant;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM float linear;
    P_UNIFORM vec3 specular;
    P_UNIFORM float quadratic;
    P_UNIFORM vec3 direction;
    P_UNIFORM float cone_scale;
    P_UNIFORM float cone_offset;
};
#define LIGHT_OF(light) Light(light.position, light.w, light.constant, light.diffuse, light.linear, light.specular, light.quadratic, light.direction, light.cone_scale, light.cone_offset)
struct Material {
    P_UNIFORM vec3 ambient;
    P_UNIFORM vec3 diffuse;
    P_UNIFORM vec3 specular;
    P_UNIFORM float shininess;
};
// storage=constant: the lights, and a material that all objects share, are constants.
const PointLight u_point[8] = PointLight[8](
    PointLight(vec3(0.699999988, 0.200000003, 2.0), 1.0, vec3(0.800000012, 0.800000012, 0.800000012), 0.0900000036, vec3(1.0, 1.0, 1.0), 0.0320000015),
    PointLight(vec3(2.29999995, -3.29999995, -4.0), 1.0, vec3(0.800000012, 0.800000012, 0.800000012), 0.0900000036, vec3(1.0, 1.0, 1.0), 0.0320000015),
    PointLight(vec3(-4.0, 2.0, -12.0), 1.0, vec3(0.800000012, 0.800000012, 0.800000012), 0.0900000036, vec3(1.0, 1.0, 1.0), 0.0320000015),
    PointLight(vec3(0.0, 0.0, -3.0), 1.0, vec3(0.800000012, 0.800000012, 0.800000012), 0.0900000036, vec3(1.0, 1.0, 1.0), 0.0320000015),
    PointLight(vec3(2.7879045, -1.46151137, -2.00670505), 1.0, vec3(0.0106878933, 0.0839441195, 0.0703679845), 0.0900000036, vec3(0.0106878933, 0.0839441195, 0.0703679845), 0.0320000015),
    PointLight(vec3(-3.13543105, 2.16856599, -5.37309933), 1.0, vec3(0.0929689854, 0.0569324121, 0.0150985997), 0.0900000036, vec3(0.0929689854, 0.0569324121, 0.0150985997), 0.0320000015),
    PointLight(vec3(1.33758163, 0.243577808, -0.476005435), 1.0, vec3(0.043317806, 0.0232060757, 0.0984761193), 0.0900000036, vec3(0.043317806, 0.0232060757, 0.0984761193), 0.0320000015),
    PointLight(vec3(1.32844889, 0.591577172, -0.0324220434), 1.0, vec3(0.0342591852, 0.0999552906, 0.0307855289), 0.0900000036, vec3(0.0342591852, 0.0999552906, 0.0307855289), 0.0320000015));
const Material u_material = Material(vec3(1.0, 0.5, 0.310000002), vec3(1.0, 0.5, 0.310000002), vec3(0.5, 0.5, 0.5), 32.0);
// The lights are elements of arrays, which stand ready.
#define DIR_LIGHT(i)   u_dir[i]
#define POINT_LIGHT(i) u_point[i]
#define SPOT_LIGHT(i)  u_spot[i]
#define AREA_LIGHT(i)  u_area[i]
#define LIGHT(i)       u_light[i]
// Nothing is to be filled before the lights are read.
void fill_lights()
{
}
// loop=constant: a bound that is known when the shader is compiled (all that GLSL ES 1.00 has,
// appendix A.4). The first point lights may cast shadows and are added apart (shadows.glsl).
#define EACH_DIR(one)   for (int i = 0; i < NR_DIR_LIGHTS; i++) { one(i) }
#define EACH_POINT(one) for (int i = NR_SHADOWS; i < NR_POINT_LIGHTS; i++) { one(i) }
#define EACH_SPOT(one)  for (int i = 0; i < NR_SPOT_LIGHTS; i++) { one(i) }
#define EACH_AREA(one)  for (int i = 0; i < NR_AREA_LIGHTS; i++) { one(i) }
#define EACH_LIGHT(one) for (int i = 0; i < NR_LIGHTS; i++) { one(i) }
// hoist=once: what is the same for all fragments comes from the CPU; what is the same for all
// lights is made before the first (the rest of this axis: IF_VIEW, IF_DIFFUSE_MAP and their
// like in src/effects/effects.def).
GIVEN_UNIFORM P_POSITION vec3 u_camera_position; // world space

P_POSITION vec3 eye()
{
    return u_camera_position;
}

P_ATTENUATION vec3 cone_axis(SpotLight light)
{
    return light.direction;
}

// Macros, since a light has what its cone reads and no more. The inverse is made in double,
// without cancellation; scale and offset of the cosine are the ramp, the cosines of the outer
// and the inner angle its edges. Of these two a light has the one that its form reads.
#define CONE_COS_CUTOFF(light)        light.cos_cutoff
#define CONE_INV_ONE_MINUS_COS(light) light.inv_one_minus_cos
#define CONE_RAMP(light)              CONE_RAMP_robust(light)
#define CONE_RAMP_robust(light)       vec2(light.cone_scale, light.cone_offset)
#define CONE_RAMP_naive(light)        vec2(0.0)
#define CONE_EDGES(light)             CONE_EDGES_robust(light)
#define CONE_EDGES_robust(light)      vec2(0.0)
#define CONE_EDGES_naive(light)       vec2(light.cos_cutoff, light.cos_inner)
// space=world: lights, positions and normals are in world space.
P_POSITION vec3 to_eye(P_POSITION vec3 position)
{
    return eye() - position;
}

P_POSITION vec3 to_world(P_POSITION vec3 v)
{
    return v;
}

P_POSITION vec3 from_world(P_POSITION vec3 v)
{
    return v;
}

// The formulas.
// guard=branch: what does not light is not added. 0 * infinity is NaN, and here no factor of 0
// is multiplied with anything.
#define CUT(inside, value) (PROBE_DECIDED(inside) ? (value) : 0.0)
// specular_norm=none: 1 is the most that a highlight can be, whatever its shininess.
#define NORM_TIMES(n, power) power
#define NORM_POW(c, n)       pow(c, n)
#define NORM_EXP2(exponent)  exp2(exponent)
// model=blinn: cosine between the half vector and the normal (Blinn 1977).
// normalise=on: c^n for the cosine c of two unit vectors, 0 where they point apart.
//
// The cosine of a small angle has lost the angle: below 1 the numbers of half precision are
// 2^-11 apart, which is 1.8 degrees, and the power multiplies that error by n: 35 of 255 steps at
// n = 64. Lagrange's identity |a x b|^2 = |a|^2 |b|^2 - (a . b)^2 gives s, the square of
// the sine, with a relative error instead (as in D_GGX of Filament), and c^n = (1 - s)^(n/2)
// follows from the series of ln(1 - s), right to 2e-6 up to s = 1/8 for every n; beyond, the
// power takes so much off that the plain cosine does.
// log2 of the cosine of an angle below 90 degrees from the square s of its sine: half of
// log2(1 - s), by the series of ln(1 - s). Five terms are right to 2e-6 of it up to s = 1/8.
#define LOG2_COSINE(s) (-0.72134752 * s * (1.0 + s * (0.5 + s * (0.33333333 + s * (0.25 + s * 0.2)))))

P_SPECULAR float cosine_power(P_VECTOR vec3 a, P_VECTOR vec3 b, P_SPECULAR float n)
{
    P_VECTOR vec3 across = cross(a, b);
    P_SPECULAR float s = dot(across, across);
    P_SPECULAR float c = dot(a, b);
    PROBE_RAW(TERM_SPECULAR, c)
    P_SPECULAR float near = LOG2_COSINE(s);
    P_SPECULAR float log2_c = s < 0.125 ? near : log2(min(c, 1.0));
    return c > 0.0 ? NORM_EXP2(n * log2_c) : 0.0;
}

// Opposite light and view vectors have no half vector, and nearly opposite ones have lost it: what
// is left of their sum is the rounding of its parts, 1e-7 in highp and 1e-3 in half precision, so at a
// length of 0.01 its direction is off by 1e-5 or 0.1. Below that (0.6 degrees) there is no highlight.
P_VECTOR vec3 half_vector_robust(P_VECTOR vec3 to_light, P_VECTOR vec3 view)
{
    P_VECTOR vec3 h = to_light + view;
    P_VECTOR float h2 = dot(h, h);
    return h2 > 1e-4 ? h * inversesqrt(h2) : vec3(0.0);
}

P_VECTOR vec3 half_vector_naive(P_VECTOR vec3 to_light, P_VECTOR vec3 view)
{
    return unit(to_light + view);
}

// What is read of a light.
#define SPECULAR_OF(light) light.specular

// Of fresnel=schlick and of specular_norm=energy.
#define FRESNEL_COSINE(surface, to_light) dot(view_of(surface), half_vector(to_light, view_of(surface)))
#define HIGHLIGHT_NORM(n) ((n + 8.0) * 0.039788736) // (n + 8) / (8 pi)

P_SPECULAR float specular_factor_robust(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 h = half_vector(to_light, view_of(surface));
    return cosine_power(surface.normal, h, surface.shininess);
}

P_SPECULAR float specular_factor_naive(Surface surface, P_VECTOR vec3 to_light)
{
    P_VECTOR vec3 h = half_vector(to_light, view_of(surface));
    P_SPECULAR float c = dot(surface.normal, h);
    PROBE_RAW(TERM_SPECULAR, c)
    return NORM_TIMES(surface.shininess, pow(max(c, 0.0), surface.shininess));
}
// fresnel=none: the surface reflects its specular colour, whatever the angle. All of the
// lights' sum has it.
#define REFLECTED u_material.specular
// ambient=scene: one term for the whole scene.
GIVEN_UNIFORM P_UNIFORM vec3 u_scene_ambient;

// What is read of a light.
#define AMBIENT_OF(light) vec3(0.0)

P_COLOR vec3 scene_ambient()
{
    P_COLOR vec3 ambient = u_scene_ambient;
    IF_DIFFUSE_MAP_EACH(ambient *= diffuse_map(v_uv);)
    return ambient;
}

void add_ambient(Incident light, inout Lit lit)
{
}
// attenuation=polynomial: 1 / (constant + linear d + quadratic d^2), the law of OpenGL's fixed
// function (OpenGL 2.1, 2.14.1).
//
// Where the constant is 0 the sum vanishes at the light, and its inverse is infinite in half
// precision from 1.5e-5 on. So a light is never more than 10000 times brighter than its colour.
P_ATTENUATION float attenuation_robust(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float slope = 0.0;
    IF_LINEAR(slope = k.y;)
    IF_QUADRATIC(slope += d * k.z;)
    return 1.0 / max(k.x + d * slope, 1e-4);
}

P_ATTENUATION float attenuation_naive(PointLight light, P_ATTENUATION float d)
{
    P_ATTENUATION vec3 k = vec3(light.constant, light.linear, light.quadratic);
    P_ATTENUATION float sum = k.x;
    IF_LINEAR(sum += k.y * d;)
    IF_QUADRATIC(sum += k.z * d * d;)
    return 1.0 / sum;
}
// cone=smooth: a ramp of the cosine between the outer and the inner angle.
//
// Robust: scale and offset have a bounded divisor (Filament, LightManager::setSpotParams).
P_ATTENUATION float cone_robust(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION vec2 ramp = CONE_RAMP(light);
    PROBE_RAW(TERM_CONE, dot(from_light, cone_axis(light)) * ramp.x + ramp.y)
    return clamp(dot(from_light, cone_axis(light)) * ramp.x + ramp.y, 0.0, 1.0);
}

// The smoothstep of equal edges is undefined (GLSL 4.60, 8.3). It eases the ramp at both ends:
// another law, with the same edges.
P_ATTENUATION float cone_naive(SpotLight light, P_ATTENUATION vec3 from_light)
{
    P_ATTENUATION float cos_a = dot(from_light, cone_axis(light));
    P_ATTENUATION vec2 edges = CONE_EDGES(light);
    PROBE_RAW(TERM_CONE, (cos_a - edges.x) / (edges.y - edges.x))
    return smoothstep(edges.x, edges.y, cos_a);
}
// What one light adds to the sums. An operation has the highest precision of its operands, so
// each step goes through a copy that has the precision of the next one.

void add_diffuse(Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    P_COLOR float weight = light.factor * light.shown * n_dot_l;
    PROBE_TERM(TERM_DIFFUSE_WEIGHT, weight)
    P_SUM vec3 added = light.diffuse * weight;
    IF_DIFFUSE_MAP_EACH(added *= diffuse_map(v_uv);)
    lit.diffuse += added;
}

void add_specular(Surface surface, Incident light, inout Lit lit)
{
    P_SPECULAR float factor = specular_factor(surface, light.highlight);
    P_COLOR float weight = light.factor * light.shown * factor;
    PROBE_TERM(TERM_SPECULAR, factor)
    PROBE_TERM(TERM_SPECULAR_WEIGHT, weight)
    P_SUM vec3 added = light.specular * weight;
    WITH_FRESNEL(P_SPECULAR float c = FRESNEL_COSINE(surface, light.highlight);)
    IF_FRESNEL(added *= reflectance(u_material.specular, c);)
    IF_SPECULAR_MAP_EACH(added *= specular_map(v_uv);)
    lit.specular += added;
}

Lit no_light()
{
    return Lit(vec3(0.0), vec3(0.0), vec3(0.0));
}
// text=corrected: no slip of a source text is reproduced (docs/sources.md).

// The lights.
// Adds one light to the sums.
// specular_side=front: a surface that faces away shows no highlight through itself.
bool specular_reaches(P_VECTOR float n_dot_l)
{
    IF_SPECULAR(PROBE_SIDE(n_dot_l > 0.0))
    return n_dot_l > 0.0;
}

P_VECTOR vec3 view_of(Surface surface)
{
    IF_VIEW_EACH(surface.view = unit_difference(to_eye(surface.position));)
    IF_VIEW_EACH(PROBE_VIEW(surface.view))
    return surface.view;
}

// guard=branch: the sides of a surface.
void add_sides(Surface surface, Incident light, P_VECTOR float n_dot_l, inout Lit lit)
{
    if (n_dot_l > 0.0) {
        IF_DIFFUSE(add_diffuse(light, n_dot_l, lit);)
    }
    if (specular_reaches(n_dot_l)) {
        IF_SPECULAR(add_specular(surface, light, lit);)
    }
}

void add_light(Surface surface, Incident light, inout Lit lit)
{
    IF_AMBIENT(add_ambient(light, lit);)
    P_VECTOR float n_dot_l = dot(surface.normal, light.direction);
    PROBE_TERM(TERM_N_DOT_L, n_dot_l)
    add_sides(surface, light, n_dot_l, lit);
    PROBE_NEXT_LIGHT
}
// Directional lights: parallel, not attenuated.
Incident dir_incident(DirLight light)
{
    P_VECTOR vec3 travels = light.direction;
    P_VECTOR vec3 direction = unit(-travels);
    PROBE_DIRECTION(direction)
    return Incident(direction, direction, 1.0, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}
// Point lights: from a position into all directions, attenuated.
P_POSITION vec3 to_point_light(PointLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 light_position = light.position;
    return light_position - surface_position;
}

Incident point_incident(PointLight light, P_POSITION vec3 surface_position)
{
    P_POSITION vec3 to_light = to_point_light(light, surface_position);
    P_VECTOR vec3 direction = unit_difference(to_light);
    PROBE_TERM(TERM_DISTANCE, length(to_light))
    PROBE_DIRECTION(direction)
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(light, length(to_light));)
    PROBE_TERM(TERM_ATTENUATION, factor)
    return Incident(direction, direction, factor, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}
// Spot lights: a point light that shines into a cone.
Incident spot_incident(SpotLight light, P_POSITION vec3 surface_position)
{
    Incident incident = point_incident(POINT_LIGHT_OF(light), surface_position);
    WITH_CONE(P_ATTENUATION float share = cone(light, -incident.direction);)
    IF_CONE(PROBE_TERM(TERM_CONE, share))
    IF_CONE(incident.factor *= share;)
    return incident;
}
// layout=split: a loop for each type of light.
// Area lights by two points of theirs: the nearest for diffuse light and distance, the one
// nearest to the reflected ray for highlights. No integral: with a radius of 0 it is the point
// light exactly, and that is the test of it.
// area_shape=sphere: a ball. Vectors from the surface: `to_centre` to the light's centre, `ray`
// of unit length along the reflected view vector.
// A ball of a radius around a point that `to_centre` leads to.

// Vector to its nearest point; from inside the ball to where one stands.
P_POSITION vec3 ball_nearest_robust(P_POSITION vec3 to_centre, P_POSITION float radius)
{
    P_POSITION float d = length(to_centre);
    return d > radius ? to_centre * ((d - radius) / d) : vec3(0.0);
}

// From inside it leads away from the centre, and at the centre it is 0 * infinity.
P_POSITION vec3 ball_nearest_naive(P_POSITION vec3 to_centre, P_POSITION float radius)
{
    P_POSITION float d = length(to_centre);
    return to_centre * ((d - radius) / d);
}

// Vector to the point of it that is nearest to the ray (Karis 2013, "Real shading in Unreal
// Engine 4", equation 11). A ray that meets the ball is not divided by how far it passes the
// centre, which may be 0.
P_POSITION vec3 ball_nearest_ray_robust(P_POSITION vec3 to_centre, P_POSITION float radius,
                                        P_POSITION vec3 ray)
{
    P_POSITION vec3 to_ray = dot(to_centre, ray) * ray - to_centre;
    P_POSITION float away = length(to_ray);
    return to_centre + (away > radius ? to_ray * (radius / away) : to_ray);
}

// The equation as printed: 0 / 0 for a ray through the centre of a ball of no radius, and
// 0 * infinity, which clamp() may hide, for one with a radius.
P_POSITION vec3 ball_nearest_ray_naive(P_POSITION vec3 to_centre, P_POSITION float radius,
                                       P_POSITION vec3 ray)
{
    P_POSITION vec3 to_ray = dot(to_centre, ray) * ray - to_centre;
    P_POSITION float scale = radius / length(to_ray);
    PROBE_RAW(TERM_DISTANCE, scale)
    return to_centre + to_ray * clamp(scale, 0.0, 1.0);
}

P_POSITION vec3 area_nearest(AreaLight light, P_POSITION vec3 to_centre)
{
    P_POSITION float radius = light.radius;
    return ball_nearest(to_centre, radius);
}

P_POSITION vec3 area_nearest_ray(AreaLight light, P_POSITION vec3 to_centre,
                                 P_POSITION vec3 ray)
{
    P_POSITION float radius = light.radius;
    return ball_nearest_ray(to_centre, radius, ray);
}

Incident area_incident(AreaLight light, Surface surface)
{
    P_POSITION vec3 light_position = light.position;
    P_POSITION vec3 to_centre = light_position - surface.position;
    P_POSITION vec3 to_light = area_nearest(light, to_centre);
    P_VECTOR vec3 direction = unit_difference(to_light);
    PROBE_TERM(TERM_DISTANCE, length(to_light))
    PROBE_DIRECTION(direction)
    P_VECTOR vec3 highlight = direction;
    WITH_SPECULAR(P_POSITION vec3 ray;)
    IF_SPECULAR(ray = reflect(-view_of(surface), surface.normal);)
    IF_SPECULAR(highlight = unit_difference(area_nearest_ray(light, to_centre, ray));)
    P_ATTENUATION float factor = 1.0;
    IF_ATTENUATION(factor = attenuation(POINT_LIGHT_OF(light), length(to_light));)
    PROBE_TERM(TERM_ATTENUATION, factor)
    return Incident(direction, highlight, factor, 1.0, AMBIENT_OF(light), light.diffuse,
                    SPECULAR_OF(light));
}

#if MAX_DIR_LIGHTS > 0
#define ADD_DIR(i) add_light(surface, dir_incident(DIR_LIGHT(i)), lit);
void add_dir_lights(Surface surface, inout Lit lit)
{
    EACH_DIR(ADD_DIR)
}
#else
void add_dir_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_POINT_LIGHTS > 0
// The first NR_SHADOWS point lights, which cast shadows.
// Shadows of the first NR_SHADOWS point lights. One entry:
//     float caster_visibility(caster, PointLight light, vec3 to_light, float n_dot_l)
// the share of the taps that the light reaches, 0 to 1; to_light: world space, from the surface
// to the light. EACH_CASTER(one) is one(0) one(1) ... for all casters: each kind of map says
// whether the number of a caster must be a constant, as the index into an array of samplers
// must in GLSL 3.30 (4.1.7) and GLSL ES 3.00 (12.29).
#if NR_SHADOWS > 0
// shadow_store=r32f: float distance.
// Stored: the distance to the light as 1 - d/range, which is 1 at the light and 0 where its range
// ends.

#define SHADOW_2D SAMPLER(P_ATTENUATION, sampler2D)
#define SHADOW_2D_ARRAY SAMPLER(P_ATTENUATION, sampler2DArray)
#define SHADOW_CUBE SAMPLER(P_ATTENUATION, samplerCube)
#define SHADOW_CUBE_ARRAY SAMPLER(P_ATTENUATION, samplerCubeArray)

// 1 where the light reaches, else 0: by two, three and four coordinates.
#define SHADOW_LIT_2(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_3(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)
#define SHADOW_LIT_4(map, at, reference) (reference > texture(map, at).r ? 1.0 : 0.0)

// Beyond the range the same in every format: 0.
P_ATTENUATION float shadow_stored_robust(P_ATTENUATION float d, P_ATTENUATION float range)
{
    return max(1.0 - d / range, 0.0);
}

// In formats that keep it, negative beyond the range.
P_ATTENUATION float shadow_stored_naive(P_ATTENUATION float d, P_ATTENUATION float range)
{
    return 1.0 - d / range;
}

P_POSITION float shadow_reference(P_POSITION vec3 to_light, P_ATTENUATION float range,
                                  P_ATTENUATION float bias)
{
    P_ATTENUATION float d = length(to_light);
    return 1.0 - d / range + bias;
}

// In the program that draws the map.
#define DECLARE_O_STORED out P_ATTENUATION float o_stored;
#define STORE(d, range) o_stored = shadow_stored(d, range);
// shadow_map=cube: a cube map a light; the hardware picks the face (OpenGL 4.6 core, 8.13).
uniform SHADOW_CUBE u_shadow_map[NR_SHADOWS];

#define EACH_CASTER(one) UNROLLED_CASTER(one)
#define SHADOW_MAP_PARAMETERS SHADOW_CUBE map
#define SHADOW_MAP_ARGUMENTS map
#define SHADOW_MAP_OF(caster) u_shadow_map[caster]

P_ATTENUATION float shadow_tap(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                               P_POSITION float reference)
{
    return SHADOW_LIT_3(map, direction, reference);
}
// shadow_filter=1: the texel that the direction meets.
P_ATTENUATION float shadow_filter(SHADOW_MAP_PARAMETERS, P_POSITION vec3 direction,
                                  P_POSITION float reference)
{
    return shadow_tap(SHADOW_MAP_ARGUMENTS, direction, reference);
}
// shadow_bias_kind=constant: the same for every surface.
P_ATTENUATION float shadow_bias(P_VECTOR float n_dot_l)
{
    return SHADOW_BIAS;
}

P_ATTENUATION float shadow_share_naive(SHADOW_MAP_PARAMETERS, PointLight light,
                                       P_POSITION vec3 to_light, P_VECTOR float n_dot_l)
{
    P_ATTENUATION float range = light.range;
    P_POSITION float reference = shadow_reference(to_light, range, shadow_bias(n_dot_l));
    return shadow_filter(SHADOW_MAP_ARGUMENTS, -to_light, reference);
}

// What lies beyond the light's range is not lit. Without asking, the bias, a format that keeps
// negative distances, and the corners of a face, which are farther than its far plane, each
// have another end of the light. A select: lookups stand under no branch.
P_ATTENUATION float shadow_share_robust(SHADOW_MAP_PARAMETERS, PointLight light,
                                        P_POSITION vec3 to_light, P_VECTOR float n_dot_l)
{
    P_POSITION float range = light.range;
    P_ATTENUATION float share =
        shadow_share_naive(SHADOW_MAP_ARGUMENTS, light, to_light, n_dot_l);
    return length(to_light) < range ? share : 0.0;
}

#define caster_visibility(i, light, l, n_dot_l) shadow_share(SHADOW_MAP_OF(i), light, l, n_dot_l)

#else
#define EACH_CASTER(one)
#endif
// As many casters as the program is made for: each shines and is shadowed.
#define WHERE_LIT(i, code) code
#define WHERE_SHADED(i, lookups) lookups

#if NR_SHADOWS > 0
Incident shaded(Incident light, P_ATTENUATION float shown)
{
    light.shown = shown;
    PROBE_SHOWN(shown)
    return light;
}

#define TO_CASTER(i) to_point_light(POINT_LIGHT(i), surface.position)
#define CASTER_N_DOT_L(i) dot(surface.normal, unit_difference(TO_CASTER(i)))
#define CASTER_SHOWN(i) caster_visibility(i, POINT_LIGHT(i), to_world(TO_CASTER(i)), CASTER_N_DOT_L(i))
#ifndef CASTER_LOOKUPS // by a slip
#define CASTER_LOOKUPS(i) CASTER_SHOWN(i)
#endif
#define ADD_CASTER(i) WHERE_LIT(i, add_light(surface, shaded(point_incident(POINT_LIGHT(i), surface.position), WHERE_SHADED(i, CASTER_LOOKUPS(i))), lit);)
void add_casters(Surface surface, inout Lit lit)
{
    EACH_CASTER(ADD_CASTER)
}
#else
void add_casters(Surface surface, inout Lit lit)
{
}
#endif
#define ADD_POINT(i) add_light(surface, point_incident(POINT_LIGHT(i), surface.position), lit);
void add_point_lights(Surface surface, inout Lit lit)
{
    add_casters(surface, lit);
    EACH_POINT(ADD_POINT)
}
#else
void add_point_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_SPOT_LIGHTS > 0
#define ADD_SPOT(i) add_light(surface, spot_incident(SPOT_LIGHT(i), surface.position), lit);
void add_spot_lights(Surface surface, inout Lit lit)
{
    EACH_SPOT(ADD_SPOT)
}
#else
void add_spot_lights(Surface surface, inout Lit lit)
{
}
#endif

#if MAX_AREA_LIGHTS > 0
#define ADD_AREA(i) add_light(surface, area_incident(AREA_LIGHT(i), surface), lit);
void add_area_lights(Surface surface, inout Lit lit)
{
    EACH_AREA(ADD_AREA)
}
#else
void add_area_lights(Surface surface, inout Lit lit)
{
}
#endif

void add_lights(Surface surface, inout Lit lit)
{
    add_dir_lights(surface, lit);
    add_point_lights(surface, lit);
    add_spot_lights(surface, lit);
    add_area_lights(surface, lit);
}

Shade shade_surface(P_POSITION vec3 position, P_VECTOR vec3 normal)
{
    fill_lights();
    Surface surface = Surface(position, normal, vec3(0.0), u_material.shininess);
    PROBE_NORMAL(surface.normal)
    IF_VIEW(surface.view = unit_difference(to_eye(position));)
    IF_VIEW(PROBE_VIEW(surface.view))
    IF_SPECULAR_NORM(log2_norm = log2(HIGHLIGHT_NORM(surface.shininess));)

    Lit lit = no_light();
    IF_AMBIENT(lit.ambient += scene_ambient();)
    add_lights(surface, lit);

    // Copies, so that the precision of the uniforms does not raise that of the products.
    P_COLOR vec3 ambient = u_material.ambient;
    P_COLOR vec3 diffuse = u_material.diffuse;
    P_COLOR vec3 specular = REFLECTED;
    Shade shade = Shade(vec3(0.0), vec3(0.0));
    IF_AMBIENT(shade.diffuse = ambient * lit.ambient;)
    IF_DIFFUSE(shade.diffuse += diffuse * lit.diffuse;)
    IF_SPECULAR(shade.specular = specular * lit.specular;)
    PROBE_OUT
    return shade;
}
// The normal that a map gives in the frame of tangent, bitangent and normal, each as
// interpolated but for the normal.

// A tangent of length 0, as exporters write it where texture coordinates collapse (MikkTSpace),
// or along the normal, and so a bitangent of length 0: the frame is flat, and the surface keeps
// its own normal. The determinant of the unit vectors tells all of them; below 1/1024 (a
// tangent within 0.06 degrees of the normal) half precision holds no direction of it.
P_VECTOR vec3 normal_in_frame_robust(P_VECTOR vec3 normal, P_VECTOR vec3 tangent,
                                     P_VECTOR vec3 bitangent, P_VECTOR vec3 bump)
{
    P_VECTOR float t2 = dot(tangent, tangent);
    P_VECTOR float b2 = dot(bitangent, bitangent);
    P_VECTOR vec3 t = t2 > 0.0 ? tangent * inversesqrt(t2) : vec3(0.0);
    P_VECTOR vec3 b = b2 > 0.0 ? bitangent * inversesqrt(b2) : vec3(0.0);
    P_VECTOR float volume = dot(cross(t, b), normal);
    return abs(volume) > 1.0 / 1024.0 ? unit(mat3(t, b, normal) * bump) : normal;
}

P_VECTOR vec3 normal_in_frame_naive(P_VECTOR vec3 normal, P_VECTOR vec3 tangent,
                                    P_VECTOR vec3 bitangent, P_VECTOR vec3 bump)
{
    return unit(mat3(normalize(tangent), normalize(bitangent), normal) * bump);
}

P_VECTOR vec3 shading_normal(P_VECTOR vec3 normal)
{
    WITH_NORMAL_MAP(P_VECTOR vec3 bump;)
    IF_NORMAL_MAP(bump = normal_map(v_uv);)
    IF_NORMAL_MAP(normal = normal_in_frame(normal, v_tangent, v_bitangent, bump);)
    return normal;
}

Shade shade_here()
{
    PROBE_INPUTS(v_position, v_normal, v_uv)
    IF_NORMAL_MAP(PROBE_FRAME(v_tangent, v_bitangent))
    return shade_surface(v_position, shading_normal(surface_normal(v_normal)));
}
// The colour as a target of half floats or an output of reduced precision takes it.

// 65504 is the largest half float; what is larger becomes infinity there. All channels are
// scaled by one factor, so that the hue stays. NaN and what is below 0 become 0 by a select: of
// NaN max() may return either operand (GLSL 4.60, 8.3). An infinite channel leaves no factor,
// and is bounded by itself.
P_SUM vec3 output_colour_robust(P_SUM vec3 colour)
{
    P_SUM float red = colour.r > 0.0 ? colour.r : 0.0;
    P_SUM float green = colour.g > 0.0 ? colour.g : 0.0;
    P_SUM float blue = colour.b > 0.0 ? colour.b : 0.0;
    P_SUM float largest = max(red, max(green, blue));
    P_SUM float scale = largest > 65504.0 ? 65504.0 / largest : 1.0;
    P_SUM vec3 light = vec3(red, green, blue);
    return min(scale > 0.0 ? light * scale : light, 65504.0);
}

P_SUM vec3 output_colour_naive(P_SUM vec3 colour)
{
    return colour;
}

#define ROW_POINT int(gl_FragCoord.y) * ROW_POINTS_ACROSS + int(gl_FragCoord.x)
// GIVEN=interpolated: all inputs stand ready.
#define TAKE_INPUTS

void main()
{
    TAKE_INPUTS
    Shade shade = shade_here();
    IF_DIFFUSE_MAP(shade.diffuse *= diffuse_map(v_uv);)
    IF_SPECULAR_MAP(shade.specular *= specular_map(v_uv);)
    IF_TINTED(shade.specular *= diffuse_map(v_uv);)
    IF_SPECULAR(shade.diffuse += shade.specular;)
    IF_NARROW_OUTPUT(shade.diffuse = output_colour(shade.diffuse);)
    o_color = vec4(shade.diffuse, 1.0);
    PROBE_PIXEL_OUT
}
