#include "emulate/module.h"

#include <string.h>

#include <spirv.h>

bool sb_spirv_relaxed(const uint32_t *word)
{
    return (sb_spirv_op(word) == SpvOpDecorate &&
            word[2] == SpvDecorationRelaxedPrecision) ||
           (sb_spirv_op(word) == SpvOpMemberDecorate &&
            word[3] == SpvDecorationRelaxedPrecision);
}

static void declare(struct sb_module *module, const uint32_t *word, enum sb_class class)
{
    if (sb_spirv_op(word) == SpvOpDecorate) {
        module->id[word[1]].declared = class;
        return;
    }
    for (int i = 0; i < module->members; i++)
        if (module->member[i].structure == word[1] && module->member[i].member == word[2])
            module->member[i].class = class;
    if (class == SB_MEDIUMP)
        module->member[module->members++] =
            (struct sb_member_class){word[1], word[2], class};
}

static void declare_all(struct sb_module *module, const struct sb_spirv *spirv,
                        enum sb_class class)
{
    for (size_t i = SB_SPIRV_HEAD; i < spirv->count; i += sb_spirv_length(&spirv->word[i]))
        if (sb_spirv_relaxed(&spirv->word[i]))
            declare(module, &spirv->word[i], class);
}

static size_t skip_relaxed(const struct sb_spirv *spirv, size_t at)
{
    while (at < spirv->count && sb_spirv_relaxed(&spirv->word[at]))
        at += sb_spirv_length(&spirv->word[at]);
    return at;
}

// glslang numbers by what it meets, so one source with other precisions has equal ids.
static bool same_program(const struct sb_spirv *a, const struct sb_spirv *b)
{
    if (memcmp(a->word, b->word, SB_SPIRV_HEAD * sizeof *a->word) != 0)
        return false;
    size_t i = SB_SPIRV_HEAD, j = SB_SPIRV_HEAD;
    for (;;) {
        i = skip_relaxed(a, i);
        j = skip_relaxed(b, j);
        if (i >= a->count || j >= b->count)
            return i >= a->count && j >= b->count;
        const size_t length = sb_spirv_length(&a->word[i]);
        if (j + length > b->count ||
            memcmp(&a->word[i], &b->word[j], length * sizeof *a->word) != 0)
            return false;
        i += length;
        j += length;
    }
}

// Values in functions are defined as they are met; here what stands before them, and what a
// call may name before it is defined.
static void define(struct sb_module *module, size_t at)
{
    const uint32_t *word = &module->word[at];
    const uint32_t op = sb_spirv_op(word);
    if (op == SpvOpName) {
        module->id[word[1]].name = (const char *)&word[2];
    } else if (op == SpvOpExtInstImport) {
        module->extensions = word[1];
    } else if (op >= SpvOpTypeVoid && op <= SpvOpTypeFunction) {
        module->id[word[1]].at = (uint32_t)at;
    } else if ((op >= SpvOpConstantTrue && op <= SpvOpSpecConstantOp) ||
               op == SpvOpVariable || op == SpvOpFunction ||
               op == SpvOpFunctionParameter || op == SpvOpUndef) {
        module->id[word[2]].at = (uint32_t)at;
        module->id[word[2]].type = word[1];
    }
    if (op == SpvOpFunction && !module->body)
        module->body = at;
}

// One round over the functions: true where one more was found to be called.
static bool spread_calls(struct sb_module *module)
{
    bool inside = false, found = false;
    for (size_t i = module->body; i < module->count;
         i += sb_spirv_length(&module->word[i])) {
        const uint32_t *word = &module->word[i];
        if (sb_spirv_op(word) == SpvOpFunction)
            inside = module->id[word[2]].called;
        if (sb_spirv_op(word) != SpvOpFunctionCall || !inside ||
            module->id[word[3]].called)
            continue;
        module->id[word[3]].called = true;
        found = true;
    }
    return found;
}

static void find_called(struct sb_module *module)
{
    for (size_t i = SB_SPIRV_HEAD; i < module->body; i += sb_spirv_length(&module->word[i]))
        if (sb_spirv_op(&module->word[i]) == SpvOpEntryPoint)
            module->id[module->word[i + 2]].called = true;
    while (spread_calls(module)) {
    }
}

bool sb_module_read(const struct sb_spirv *spirv, const struct sb_spirv *lowp,
                    struct sb_arena *arena, struct sb_module *module,
                    struct sb_error *err)
{
    *module = (struct sb_module){.word = spirv->word, .count = spirv->count};
    if (lowp && !same_program(spirv, lowp))
        return sb_fail(err, SB_INTERNAL,
                       "the shader with highp for mediump is another program, so what is "
                       "lowp cannot be told");
    module->bound = spirv->word[3];
    module->id = sb_arena_alloc(arena, module->bound * sizeof *module->id);
    int members = 0;
    for (size_t i = SB_SPIRV_HEAD; i < spirv->count;
         i += sb_spirv_length(&spirv->word[i])) {
        define(module, i);
        members += sb_spirv_op(&spirv->word[i]) == SpvOpMemberDecorate;
    }
    module->member = sb_arena_alloc(arena, (size_t)members * sizeof *module->member);
    declare_all(module, spirv, SB_MEDIUMP);
    if (lowp)
        declare_all(module, lowp, SB_LOWP);
    find_called(module);
    return true;
}

bool sb_module_shape(const struct sb_module *module, uint32_t type, struct sb_shape *shape)
{
    const uint32_t *word = &module->word[module->id[type].at];
    *shape = (struct sb_shape){1, 1};
    if (module->id[type].at == 0)
        return false;
    if (sb_spirv_op(word) == SpvOpTypeMatrix) {
        shape->columns = (int)word[3];
        word = &module->word[module->id[word[2]].at];
    }
    if (sb_spirv_op(word) == SpvOpTypeVector) {
        shape->rows = (int)word[3];
        word = &module->word[module->id[word[2]].at];
    }
    return sb_spirv_op(word) == SpvOpTypeFloat;
}

enum sb_class sb_module_member(const struct sb_module *module, uint32_t structure,
                               uint32_t member)
{
    for (int i = 0; i < module->members; i++)
        if (module->member[i].structure == structure && module->member[i].member == member)
            return module->member[i].class;
    return SB_HIGHP;
}

bool sb_module_constant(const struct sb_module *module, uint32_t id, uint32_t *bits)
{
    const uint32_t *word = &module->word[module->id[id].at];
    if (module->id[id].at == 0 || sb_spirv_op(word) != SpvOpConstant)
        return false;
    *bits = word[3];
    return true;
}
