// Lights into the uniforms of a program: where each member goes is looked up by name, and by
// reflection, rather than computed. So it is right for every kind of storage and every block
// layout, for programs with fewer lights than the scene, and for members that a program does
// not use.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "render/calls.h"
#include "render/render.h"

enum { WHOLE_LIST = SB_LIGHT_TYPE_COUNT };

struct search { // what find_… share
    struct sb_light_upload *upload;
    GLuint block;       // index of Lights, or GL_INVALID_INDEX
    size_t staged_size; // bytes of member arrays found so far
    bool pads;          // the entries beyond a list are set to intensity 0
};

static void add_place(struct search *search, struct sb_light_place place,
                      const struct sb_light_field *field)
{
    struct sb_light_upload *upload = search->upload;
    place.source = (size_t)field->offset;
    place.components = field->components;
    place.pads = search->pads && strcmp(field->name, "intensity") == 0;
    upload->place = sb_grow(upload->place, upload->place_count, &upload->place_capacity,
                            sizeof *upload->place);
    upload->place[upload->place_count++] = place;
}

// storage=arrays: u_point_position[N].
static void find_array(struct search *search, const struct sb_light_struct *row, int list,
                       const struct sb_light_field *field, int capacity)
{
    struct sb_light_upload *upload = search->upload;
    char name[96];
    snprintf(name, sizeof name, "%s_%s", row->array, field->name);
    const GLint location = glGetUniformLocation(upload->program, name);
    if (location < 0)
        return;
    const size_t element = (size_t)field->components * sizeof(float);
    upload->array = sb_grow(upload->array, upload->array_count, &upload->array_capacity,
                            sizeof *upload->array);
    upload->array[upload->array_count++] = (struct sb_member_array){
        location, field->components, capacity, search->staged_size};
    for (int i = 0; i < capacity; i++) {
        const size_t staged = search->staged_size + element * (size_t)i;
        add_place(search,
                  (struct sb_light_place){list, i, .location = -1, .staged = staged},
                  field);
    }
    search->staged_size += element * (size_t)capacity;
}

// u_point[3].position, in the default block or in the block Lights.
static void find_member(struct search *search, const struct sb_light_struct *row,
                        int list, const struct sb_light_field *field, int light)
{
    const GLuint program = search->upload->program;
    char name[96];
    const char *const names = name;
    snprintf(name, sizeof name, "%s[%d].%s", row->array, light, field->name);
    const GLint location = glGetUniformLocation(program, name);
    if (location >= 0) {
        add_place(search, (struct sb_light_place){list, light, .location = location},
                  field);
        return;
    }
    if (search->block == GL_INVALID_INDEX)
        return;
    GLuint index;
    GLint offset = -1;
    glGetUniformIndices(program, 1, &names, &index);
    if (index != GL_INVALID_INDEX)
        glGetActiveUniformsiv(program, 1, &index, GL_UNIFORM_OFFSET, &offset);
    if (offset >= 0)
        add_place(search,
                  (struct sb_light_place){list, light, .location = -1,
                                          .staged = (size_t)offset},
                  field);
}

static void find_struct(struct search *search, int struct_number, int list, int capacity)
{
    const struct sb_light_struct *row = &sb_light_structs[struct_number];
    search->upload->count[struct_number] =
        glGetUniformLocation(search->upload->program, row->count);
    for (int f = 0; capacity > 0 && f < row->field_count; f++)
        find_array(search, row, list, &row->field[f], capacity);
    for (int i = 0; i < capacity; i++) {
        for (int f = 0; f < row->field_count; f++)
            find_member(search, row, list, &row->field[f], i);
    }
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

// Fills upload->block_size and ->buffer where there is a block Lights.
static GLuint find_block(struct sb_light_upload *upload, const struct sb_variant *variant)
{
    const GLuint block = glGetUniformBlockIndex(upload->program, "Lights");
    if (block == GL_INVALID_INDEX)
        return block;
    const bool moves = variant->value[SB_AXIS_UPDATE] != SB_UPDATE_STATIC;
    glUniformBlockBinding(upload->program, block, 0);
    glGetActiveUniformBlockiv(upload->program, block, GL_UNIFORM_BLOCK_DATA_SIZE,
                              &upload->block_size);
    glGenBuffers(1, &upload->buffer);
    glBindBuffer(GL_UNIFORM_BUFFER, upload->buffer);
    glBufferData(GL_UNIFORM_BUFFER, upload->block_size, NULL,
                 moves ? GL_DYNAMIC_DRAW : GL_STATIC_DRAW);
    return block;
}

void sb_light_upload_make(struct sb_light_upload *upload, GLuint program,
                          const struct sb_variant *variant,
                          const struct sb_lights *lights)
{
    const double *value = variant->value;
    // The text sets the lights that there are, and so leaves what an earlier and longer list
    // has put behind them.
    const bool stale = value[SB_AXIS_SOURCE] == SB_SOURCE_LWJGL &&
                       value[SB_AXIS_TEXT] == SB_TEXT_AS_WRITTEN;
    *upload = (struct sb_light_upload){.program = program};
    struct search search = {
        .upload = upload,
        .block = find_block(upload, variant),
        .staged_size = 0,
        .pads = value[SB_AXIS_LOOP] == SB_LOOP_PADDED && !stale,
    };
    const bool unified = value[SB_AXIS_LAYOUT] == SB_LAYOUT_UNIFIED;
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++) {
        const int slots = larger(lights->count[type],
                                 sb_lights_slots(variant, (enum sb_light_type)type));
        find_struct(&search, type, type, unified ? 0 : slots);
    }
    const int slots = larger(sb_lights_total(lights), sb_lights_unified_slots(variant));
    find_struct(&search, SB_LIGHT_UNIFIED, WHOLE_LIST, unified ? slots : 0);

    // A program has its lights in a block or in arrays, not in both.
    if (search.staged_size < (size_t)upload->block_size)
        search.staged_size = (size_t)upload->block_size;
    upload->staged = sb_alloc(search.staged_size);
    upload->sets_uniforms = upload->array_count > 0;
    for (int i = 0; i < SB_LIGHT_STRUCT_COUNT; i++)
        upload->sets_uniforms |= upload->count[i] >= 0;
    for (int i = 0; i < upload->place_count; i++)
        upload->sets_uniforms |= upload->place[i].location >= 0;
}

void sb_light_upload_free(struct sb_light_upload *upload)
{
    glDeleteBuffers(1, &upload->buffer);
    free(upload->place);
    free(upload->array);
    free(upload->staged);
    *upload = (struct sb_light_upload){0};
}

static void set_float(GLint location, int components, int count, const float *value,
                      int64_t *calls)
{
    if (components == 1)
        GL(glUniform1fv(location, count, value));
    else
        GL(glUniform3fv(location, count, value));
}

int64_t sb_light_upload_set(const struct sb_light_upload *upload,
                            const struct sb_lights *lights)
{
    static const float off = 0;
    const struct sb_light *list[SB_LIGHT_STRUCT_COUNT] = {[WHOLE_LIST] = lights->light};
    int length[SB_LIGHT_STRUCT_COUNT] = {[WHOLE_LIST] = sb_lights_total(lights)};
    for (int type = 0; type < SB_LIGHT_TYPE_COUNT; type++)
        list[type] = sb_lights_of(lights, type, &length[type]);

    int64_t count = 0, *const calls = &count;
    if (upload->sets_uniforms)
        GL(glUseProgram(upload->program));
    for (int i = 0; i < upload->place_count; i++) {
        const struct sb_light_place *place = &upload->place[i];
        const void *value = &off;
        if (place->light < length[place->list])
            value = (const char *)(list[place->list] + place->light) + place->source;
        else if (!place->pads)
            continue;
        if (place->location >= 0)
            set_float(place->location, place->components, 1, value, calls);
        else
            memcpy(upload->staged + place->staged, value,
                   (size_t)place->components * sizeof(float));
    }
    for (int i = 0; i < upload->array_count; i++) {
        const struct sb_member_array *array = &upload->array[i];
        set_float(array->location, array->components, array->count,
                  (const void *)(upload->staged + array->staged), calls);
    }
    if (upload->buffer) {
        GL(glBindBuffer(GL_UNIFORM_BUFFER, upload->buffer));
        GL(glBufferSubData(GL_UNIFORM_BUFFER, 0, upload->block_size, upload->staged));
    }
    for (int i = 0; i < SB_LIGHT_STRUCT_COUNT; i++) {
        if (upload->count[i] >= 0)
            GL(glUniform1i(upload->count[i], length[i]));
    }
    return count;
}
