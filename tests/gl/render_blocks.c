// Uniform blocks: what the driver says of their layout, and materials in ranges of one buffer.
#include "render_world.h"

static GLint uniform_value(GLuint program, const char *name, GLenum what)
{
    GLuint index;
    GLint value = -1;
    glGetUniformIndices(program, 1, &name, &index);
    if (index == GL_INVALID_INDEX)
        fail_msg("the driver does not know %s", name);
    glGetActiveUniformsiv(program, 1, &index, what, &value);
    return value;
}

// As if a variant read all that there is.
static void all_members(const struct sb_light_struct *row,
                        struct sb_light_members *members)
{
    for (members->count = 0; members->count < row->field_count; members->count++)
        members->field[members->count] = &row->field[members->count];
}

// The declared count does not matter: two elements tell the size of one.
static void the_driver_has_the_std140_offsets_of_every_member_of_every_struct(
    void **state)
{
    (void)state;
    for (int s = 0; s < SB_LIGHT_STRUCT_COUNT; s++) {
        const struct sb_light_struct *row = &sb_light_structs[s];
        struct light_text lights = {.storage = AS_STD140};
        struct sb_light_members members;
        struct fixture fixture;
        all_members(row, &members);
        lights.count[s] = 2;
        fixture_init(&fixture);
        if (s == SB_LIGHT_UNIFIED)
            fixture.variant.value[SB_AXIS_LAYOUT] = SB_LAYOUT_UNIFIED;
        fixture_make_members(&fixture, &lights);
        const size_t size = sb_light_std140_size(&members);
        for (int i = 0; i < 2; i++) {
            for (int f = 0; f < row->field_count; f++) {
                struct sb_text name = {0};
                add_member(&name, &lights, s, i, &row->field[f]);
                assert_int_equal(
                    uniform_value(fixture.program.name, name.data, GL_UNIFORM_OFFSET),
                    (size_t)i * size + sb_light_std140_offset(&members, f));
                sb_text_free(&name);
            }
        }
        assert_int_equal(fixture.binding.lights.block_size, 2 * size);
        fixture_free(&fixture);
    }
}

// --- materials -------------------------------------------------------------------------

enum { MATERIALS = 3 };

// A strip for each material: the target's left, middle and right third.
struct strips {
    struct sb_material material[MATERIALS];
    struct sb_draw draw[MATERIALS];
};

static void strips_make(struct strips *strips, struct world *world)
{
    float next = 100;
    *strips = (struct strips){0};
    number(strips->material, sizeof strips->material, &next);
    for (int i = 0; i < MATERIALS; i++) {
        strips->draw[i].material = MATERIALS - 1 - i;
        strips->draw[i].lamp = -1;
        // Each covers what is right of its left border, in front of those before it.
        const float model[16] = {
            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2.0f * (float)i / 3, 0, -0.1f * (float)i,
            1};
        memcpy(strips->draw[i].model, model, sizeof model);
    }
    world->scene.material = strips->material;
    world->scene.draw = strips->draw;
    world->scene.material_count = world->scene.draw_count = MATERIALS;
}

static void strips_fixture_make(struct fixture *fixture, struct strips *strips,
                                const char *layout)
{
    struct sb_text vertex = {0}, text = {0};
    fixture_init(fixture);
    strips_make(strips, &fixture->world);
    add_vertex_shader(&vertex, caps.gles);
    add_version(&text, caps.gles);
    sb_text_printf(
        &text,
        "struct Material { vec3 ambient, diffuse, specular; float shininess; };\n"
        "layout(%s) uniform MaterialBlock { Material u_material; };\n"
        "out vec4 o_color;\n"
        "void main()\n"
        "{\n"
        "    int x = int(gl_FragCoord.x) %% 4;\n"
        "    o_color = vec4(u_material.shininess);\n"
        "    if (x == 1) o_color.xyz = u_material.ambient;\n"
        "    else if (x == 2) o_color.xyz = u_material.diffuse;\n"
        "    else if (x == 3) o_color.xyz = u_material.specular;\n"
        "}\n",
        layout);
    fixture_make(fixture, vertex.data, text.data);
    sb_text_free(&vertex);
    sb_text_free(&text);
}

static void check_strips(const struct fixture *fixture, const struct strips *strips)
{
    struct sb_image image;
    draw_frame(fixture, -1);
    read_target(fixture, &image);
    for (int x = 0; x < MEMBERS_MAX; x++) {
        const int strip = (3 * x + 1) / MEMBERS_MAX;
        const struct sb_material *material = &strips->material[MATERIALS - 1 - strip];
        const float *members[] = {NULL, material->ambient, material->diffuse,
                                  material->specular};
        for (int c = 0; c < 4; c++) {
            const float want =
                x % 4 == 0 || c == 3 ? material->shininess : members[x % 4][c];
            check_close(sb_image_at(&image, x, 0)[c], want, 0);
        }
    }
    sb_image_free(&image);
}

static void every_draw_has_its_own_material_from_a_block(void **state)
{
    (void)state;
    static const char *const layouts[] = {"std140", "shared"};
    for (int i = 0; i < 2; i++) {
        struct fixture fixture;
        struct strips strips;
        strips_fixture_make(&fixture, &strips, layouts[i]);
        check_strips(&fixture, &strips);
        fixture_free(&fixture);
    }
}

static PFNGLGETINTEGERVPROC real_get;
static PFNGLBINDBUFFERRANGEPROC real_range;
static GLintptr ranges_seen[16];
static int range_count;

static void GLAD_API_PTR coarse_alignment(GLenum name, GLint *value)
{
    real_get(name, value);
    if (name == GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)
        *value = 256;
}

static void GLAD_API_PTR see_range(GLenum target, GLuint index, GLuint buffer,
                                   GLintptr offset, GLsizeiptr size)
{
    assert_in_range(range_count, 0, 15);
    ranges_seen[range_count++] = offset;
    real_range(target, index, buffer, offset, size);
}

// NVIDIA's drivers want multiples of 256.
static void ranges_of_materials_keep_to_the_driver_s_alignment(void **state)
{
    (void)state;
    struct fixture fixture;
    struct strips strips;
    real_get = glad_glGetIntegerv;
    glad_glGetIntegerv = coarse_alignment;
    strips_fixture_make(&fixture, &strips, "std140");
    glad_glGetIntegerv = real_get;
    real_range = glad_glBindBufferRange;
    glad_glBindBufferRange = see_range;
    range_count = 0;
    check_strips(&fixture, &strips);
    glad_glBindBufferRange = real_range;
    assert_int_equal(range_count, MATERIALS);
    for (int i = 0; i < MATERIALS; i++)
        assert_int_equal(ranges_seen[i], 256 * (MATERIALS - 1 - i));
    fixture_free(&fixture);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            the_driver_has_the_std140_offsets_of_every_member_of_every_struct),
        cmocka_unit_test(every_draw_has_its_own_material_from_a_block),
        cmocka_unit_test(ranges_of_materials_keep_to_the_driver_s_alignment),
    };
    return run_with_context(tests, sizeof tests / sizeof *tests);
}
