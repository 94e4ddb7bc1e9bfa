#include "emulate/module.h"

#include <string.h>

#include <GLSL.std.450.h>
#include <spirv.h>

#include "emulate/operations.h"

bool sb_spirv_relaxed(const uint32_t *word)
{
    return (sb_spirv_op(word) == SpvOpDecorate &&
            word[2] == SpvDecorationRelaxedPrecision) ||
           (sb_spirv_op(word) == SpvOpMemberDecorate &&
            word[3] == SpvDecorationRelaxedPrecision);
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
    for (size_t i = SB_SPIRV_HEAD; i < module->body;
         i += sb_spirv_length(&module->word[i]))
        if (sb_spirv_op(&module->word[i]) == SpvOpEntryPoint)
            module->id[module->word[i + 2]].called = true;
    while (spread_calls(module)) {
    }
}

static void declare(struct sb_module *module)
{
    for (size_t i = SB_SPIRV_HEAD; i < module->body;
         i += sb_spirv_length(&module->word[i])) {
        const uint32_t *word = &module->word[i];
        if (!sb_spirv_relaxed(word))
            continue;
        if (sb_spirv_op(word) == SpvOpDecorate)
            module->id[word[1]].declared = SB_MEDIUMP;
        else
            module->member[module->members++] =
                (struct sb_member_class){word[1], word[2], SB_MEDIUMP};
    }
}

static void read_one(const struct sb_spirv *spirv, struct sb_arena *arena,
                     struct sb_module *module)
{
    *module = (struct sb_module){.word = spirv->word, .count = spirv->count};
    module->bound = spirv->word[3];
    module->id = sb_arena_alloc(arena, module->bound * sizeof *module->id);
    int members = 0;
    for (size_t i = SB_SPIRV_HEAD; i < spirv->count;
         i += sb_spirv_length(&spirv->word[i])) {
        define(module, i);
        members += sb_spirv_op(&spirv->word[i]) == SpvOpMemberDecorate;
    }
    module->member = sb_arena_alloc(arena, (size_t)members * sizeof *module->member);
    declare(module);
    find_called(module);
}

// What has a precision in the source. glslang adds variables where precisions differ, without a
// name or with one of these, so they and what reads and writes them are of no use here.
static bool has_precision(const struct sb_module *module, const uint32_t *word)
{
    const char *name;
    switch (sb_spirv_op(word)) {
    case SpvOpTypeStruct:
    case SpvOpFunction:
    case SpvOpFunctionParameter:
    case SpvOpFunctionCall:
    case SpvOpCompositeExtract:
        return true;
    case SpvOpVariable:
        name = module->id[word[2]].name;
        return name && *name && strcmp(name, "param") != 0 && strcmp(name, "arg") != 0;
    default:
        return sb_operation_of(word, module->extensions);
    }
}

static const uint32_t *next_with_precision(const struct sb_module *module, size_t *at)
{
    while (*at < module->count) {
        const uint32_t *word = &module->word[*at];
        *at += sb_spirv_length(word);
        if (has_precision(module, word))
            return word;
    }
    return NULL;
}

static void lower_members(struct sb_module *module, uint32_t structure,
                          const struct sb_module *lowp, uint32_t lowp_structure)
{
    for (int i = 0; i < module->members; i++)
        if (module->member[i].structure == structure &&
            sb_module_member(lowp, lowp_structure, module->member[i].member) != SB_HIGHP)
            module->member[i].class = SB_LOWP;
}

// Built-ins that are mediump by the language (GLSL ES 3.00, 7.2, 8.4).
static bool is_mediump_builtin(const struct sb_module *module, const uint32_t *word)
{
    const char *name = module->id[word[2]].name;
    switch (sb_spirv_op(word)) {
    case SpvOpExtInst:
        return word[4] == GLSLstd450UnpackHalf2x16 ||
               word[4] == GLSLstd450UnpackUnorm4x8 || word[4] == GLSLstd450UnpackSnorm4x8;
    case SpvOpVariable:
        return name && strncmp(name, "gl_", 3) == 0;
    default:
        return false;
    }
}

// glslang meets both sources in the same order.
static bool find_lowp(struct sb_module *module, const struct sb_module *lowp)
{
    size_t i = SB_SPIRV_HEAD, j = SB_SPIRV_HEAD;
    for (;;) {
        const uint32_t *a = next_with_precision(module, &i);
        const uint32_t *b = next_with_precision(lowp, &j);
        if (!a || !b)
            return a == b;
        if (sb_spirv_op(a) != sb_spirv_op(b))
            return false;
        if (sb_spirv_op(a) == SpvOpTypeStruct)
            lower_members(module, a[1], lowp, b[1]);
        else if (lowp->id[b[2]].declared != SB_HIGHP &&
                 module->id[a[2]].declared != SB_HIGHP && !is_mediump_builtin(module, a))
            module->id[a[2]].declared = SB_LOWP;
    }
}

bool sb_module_read(const struct sb_spirv *spirv, const struct sb_spirv *lowp,
                    struct sb_arena *arena, struct sb_module *module,
                    struct sb_error *err)
{
    struct sb_module relaxed;
    read_one(spirv, arena, module);
    if (!lowp)
        return true;
    read_one(lowp, arena, &relaxed);
    return find_lowp(module, &relaxed) ||
           sb_fail(err, SB_INTERNAL,
                   "the shader with highp for mediump is another program, so what is "
                   "lowp cannot be told");
}

bool sb_module_shape(const struct sb_module *module, uint32_t type,
                     struct sb_shape *shape)
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
        if (module->member[i].structure == structure &&
            module->member[i].member == member)
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
