// Attributes, materials, matrices and the camera arrive as docs/glsl.md says: each value is
// written to a pixel of its own and compared with the C struct. (Lights: render_lights.c.)
#include "render_world.h"

static const char attributes_vertex[] =
    "in vec3 a_position;\n"
    "in vec3 a_normal;\n"
    "in vec2 a_uv;\n"
    "in vec4 a_tangent;\n"
    "uniform mat4 u_model;\n"
    "uniform mat4 u_view_projection;\n"
    "flat out vec3 v_normal;\n"
    "flat out vec2 v_uv;\n"
    "flat out vec4 v_tangent;\n"
    "void main()\n"
    "{\n"
    "    v_normal = a_normal;\n"
    "    v_uv = a_uv;\n"
    "    v_tangent = a_tangent;\n"
    "    gl_Position = u_view_projection * (u_model * vec4(a_position, 1.0));\n"
    "}\n";

static const char all_values_fragment[] =
    "struct material { vec3 ambient, diffuse, specular; float shininess; };\n"
    "uniform material u_material;\n"
    "uniform mat4 u_model;\n"
    "uniform mat3 u_normal_matrix;\n"
    "uniform mat4 u_view_projection, u_view, u_view_inverse;\n"
    "uniform mat3 u_view_rotation;\n"
    "uniform vec3 u_camera_position;\n"
    "uniform vec3 u_scene_ambient;\n"
    "uniform vec3 u_lamp_colour;\n"
    "flat in vec3 v_normal;\n"
    "flat in vec2 v_uv;\n"
    "flat in vec4 v_tangent;\n"
    "out vec4 o_color;\n"
    "void main()\n"
    "{\n"
    "    int x = int(gl_FragCoord.x);\n"
    "    o_color = vec4(0.0);\n"
    "    if (x < 4) o_color = u_model[x];\n"
    "    else if (x < 8) o_color = u_view_projection[x - 4];\n"
    "    else if (x < 11) o_color.xyz = u_normal_matrix[x - 8];\n"
    "    else if (x == 11) o_color.xyz = u_camera_position;\n"
    "    else if (x == 12) o_color.xyz = u_scene_ambient;\n"
    "    else if (x == 13) o_color.xyz = u_material.ambient;\n"
    "    else if (x == 14) o_color.xyz = u_material.diffuse;\n"
    "    else if (x == 15) o_color.xyz = u_material.specular;\n"
    "    else if (x == 16) o_color.x = u_material.shininess;\n"
    "    else if (x == 17) o_color.xyz = v_normal;\n"
    "    else if (x == 18) o_color.xy = v_uv;\n"
    "    else if (x == 19) o_color = v_tangent;\n"
    "    else if (x == 20) o_color.xyz = u_lamp_colour;\n"
    "    else if (x < 25) o_color = u_view[x - 21];\n"
    "    else if (x < 29) o_color = u_view_inverse[x - 25];\n"
    "    else if (x < 32) o_color.xyz = u_view_rotation[x - 29];\n"
    "}\n";

// Other matrices than the identity that still cover the target, and numbers for the rest.
static void world_number(struct world *world)
{
    float next = 1000;
    static const float model[16] = {2, 0, 0, 0, 0, 4, 0, 0, 0, 0, 8, 0, 0, 0, 0, 1};
    static const float halved[16] = {0.5f, 0, 0,      0, 0, 0.25f, 0, 0,
                                     0,    0, 0.125f, 0, 0, 0,     0, 1};
    memcpy(world->draw.model, model, sizeof model);
    memcpy(world->scene.camera.view_projection, halved, sizeof halved);
    number(world->draw.normal_matrix, sizeof world->draw.normal_matrix, &next);
    number(world->scene.camera.eye, sizeof world->scene.camera.eye, &next);
    number(world->scene.ambient, sizeof world->scene.ambient, &next);
    number(&world->material, sizeof world->material, &next);
    struct sb_vertex *vertex = world->vertex;
    number(vertex[0].normal, sizeof vertex[0].normal, &next);
    number(vertex[0].uv, sizeof vertex[0].uv, &next);
    number(vertex[0].tangent, sizeof vertex[0].tangent, &next);
    for (int i = 1; i < 3; i++) {
        memcpy(vertex[i].normal, vertex[0].normal, sizeof vertex[0].normal);
        memcpy(vertex[i].uv, vertex[0].uv, sizeof vertex[0].uv);
        memcpy(vertex[i].tangent, vertex[0].tangent, sizeof vertex[0].tangent);
    }
}

// Axes: x' = 1 - z, y' = y + 2, z' = x + 3; seen from where all three are 0.
static const float quarter_turn[16] = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 2, 3, 1};
static const float turned_back[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, -3, -2, 1, 1};
static const float turn_alone[9] = {0, 0, 1, 0, 1, 0, -1, 0, 0};

static void numbered_fixture_make(struct fixture *fixture)
{
    static const float eye[3] = {-3, -2, 1};
    struct sb_text vertex = {0}, fragment = {0};
    add_version(&vertex, caps.gles);
    sb_text_add(&vertex, attributes_vertex);
    add_version(&fragment, caps.gles);
    sb_text_add(&fragment, all_values_fragment);
    world_number(&fixture->world);
    memcpy(fixture->world.scene.camera.view, quarter_turn, sizeof quarter_turn);
    memcpy(fixture->world.scene.camera.eye, eye, sizeof eye);
    fixture->world.draw.lamp = POINT - 1;
    fixture_make(fixture, vertex.data, fragment.data);
    sb_text_free(&vertex);
    sb_text_free(&fragment);
}

static void every_attribute_and_every_other_uniform_arrives(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    fixture_init(&fixture);
    numbered_fixture_make(&fixture);
    draw_frame(&fixture, -1);
    read_target(&fixture, &image);

    const struct world *world = &fixture.world;
    const struct {
        const float *value;
        int count, components; // count pixels of so many components
    } want[] = {
        {world->draw.model, 4, 4},
        {world->scene.camera.view_projection, 4, 4},
        {world->draw.normal_matrix, 3, 3},
        {world->scene.camera.eye, 1, 3},
        {world->scene.ambient, 1, 3},
        {world->material.ambient, 1, 3},
        {world->material.diffuse, 1, 3},
        {world->material.specular, 1, 3},
        {&world->material.shininess, 1, 1},
        {world->vertex[0].normal, 1, 3},
        {world->vertex[0].uv, 1, 2},
        {world->vertex[0].tangent, 1, 4},
        {world->light[DIR + POINT - 1].diffuse, 1, 3},
        {quarter_turn, 4, 4},
        {turned_back, 4, 4},
        {turn_alone, 3, 3},
    };
    int pixel = 0;
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        for (int j = 0; j < want[i].count * want[i].components; j++)
            check_close(sb_image_at(&image, pixel + j / want[i].components,
                                    0)[j % want[i].components],
                        want[i].value[j], 0);
        pixel += want[i].count;
    }
    assert_int_equal(pixel, 32);
    sb_image_free(&image);
    fixture_free(&fixture);
}

static void normals_of_view_space_are_turned_once_more(void **state)
{
    (void)state;
    struct fixture fixture;
    struct sb_image image;
    fixture_init(&fixture);
    fixture.variant.value[SB_AXIS_SPACE] = SB_SPACE_VIEW;
    numbered_fixture_make(&fixture);
    draw_frame(&fixture, -1);
    read_target(&fixture, &image);
    for (int column = 0; column < 3; column++) {
        const float *of_world = &fixture.world.draw.normal_matrix[3 * column];
        const float *seen = sb_image_at(&image, 8 + column, 0);
        check_close(seen[0], -of_world[2], 0);
        check_close(seen[1], of_world[1], 0);
        check_close(seen[2], of_world[0], 0);
    }
    for (int c = 0; c < 3; c++) // the camera's place stays one of the world
        check_close(sb_image_at(&image, 11, 0)[c], fixture.world.scene.camera.eye[c], 0);
    sb_image_free(&image);
    fixture_free(&fixture);
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_attribute_and_every_other_uniform_arrives),
        cmocka_unit_test(normals_of_view_space_are_turned_once_more),
    };
    return run_with_context(tests, sizeof tests / sizeof *tests);
}
