#include "emulate/round.h"

#include <stdio.h>
#include <string.h>

#include <spirv.h>

#include "emulate/helpers.h"
#include "emulate/operations.h"
#include "emulate/rename.h"

struct value {
    uint32_t type, root; // root: of a pointer, the variable or parameter it leads into
    // Of a value: what it is rounded to. Of a pointer: of what it points to.
    enum sb_class class;
};

struct function {
    const char *name; // with the types of its parameters: "sb_dot_16(vf3;vf3;"
    uint32_t id;
};

struct pass {
    const struct sb_module *module;
    struct value *value;
    struct sb_word_list out, patched;
    struct function *function;
    int functions, rounded;
    uint32_t next_id;
    enum sb_class returns; // of the function that stands open
};

static enum sb_class lower(enum sb_class a, enum sb_class b)
{
    return a < b ? a : b;
}

static bool is_float(const struct pass *pass, uint32_t id)
{
    struct sb_shape shape;
    return id < pass->module->bound &&
           sb_module_shape(pass->module, pass->value[id].type, &shape);
}

// The types in glslang's names of functions: "f1;", "vf3;", "mf23;" of 2 columns.
static int mangled(const struct pass *pass, uint32_t type, char *text, size_t size)
{
    struct sb_shape shape;
    sb_module_shape(pass->module, type, &shape);
    if (shape.columns > 1)
        return snprintf(text, size, "mf%d%d;", shape.columns, shape.rows);
    return snprintf(text, size, shape.rows > 1 ? "vf%d;" : "f%d;", shape.rows);
}

static uint32_t function_of(const struct pass *pass, const char *name,
                            enum sb_class class, const uint32_t *type, int types)
{
    char text[64];
    int length = snprintf(text, sizeof text, "%s%s(", name,
                          class == SB_LOWP ? SB_ROUND_10 : SB_ROUND_16);
    for (int i = 0; i < types; i++)
        length += mangled(pass, type[i], text + length, sizeof text - (size_t)length);
    for (int i = 0; i < pass->functions; i++)
        if (strcmp(pass->function[i].name, text) == 0)
            return pass->function[i].id;
    return 0;
}

static void call(struct pass *pass, uint32_t type, uint32_t result, uint32_t function,
                 const uint32_t *argument, int arguments)
{
    sb_words_add(&pass->out, (uint32_t)(4 + arguments) << 16 | SpvOpFunctionCall);
    sb_words_add(&pass->out, type);
    sb_words_add(&pass->out, result);
    sb_words_add(&pass->out, function);
    for (int i = 0; i < arguments; i++)
        sb_words_add(&pass->out, argument[i]);
}

// `result` becomes the rounded `id`.
static void call_round(struct pass *pass, uint32_t type, uint32_t result, uint32_t id,
                       enum sb_class class)
{
    call(pass, type, result, function_of(pass, "sb_round", class, &type, 1), &id, 1);
}

// Constants that rounding leaves alone, whatever the rules; a subnormal may be flushed.
static bool is_exact(const struct sb_module *module, uint32_t id, enum sb_class class)
{
    const uint32_t *word = &module->word[module->id[id].at];
    uint32_t bits;
    float number;
    if (sb_spirv_op(word) == SpvOpConstantComposite) {
        bool exact = true;
        for (uint32_t i = 3; exact && i < sb_spirv_length(word); i++)
            exact = is_exact(module, word[i], class);
        return exact;
    }
    if (!sb_module_constant(module, id, &bits))
        return false;
    memcpy(&number, &bits, sizeof number);
    if (class == SB_LOWP) // a multiple of 1/256 from -2 to below 2, and no -0
        return bits == 0 || (number >= -2 && number < 2 &&
                             number * 256 == (float)(int)(number * 256) && number != 0);
    return (bits & 0x7fffffff) == 0 ||
           (number >= -65504 && number <= 65504 &&
            (number >= 0x1p-14f || number <= -0x1p-14f) && (bits & 0x1fff) == 0);
}

// The value as an operand of an operation of that class.
static uint32_t operand(struct pass *pass, uint32_t id, enum sb_class class)
{
    const enum sb_class is = pass->value[id].class;
    if (class == SB_HIGHP || class == SB_NO_CLASS || !is_float(pass, id) ||
        (is != SB_NO_CLASS && is >= class))
        return id;
    if (is == SB_NO_CLASS && pass->module->id[id].at && is_exact(pass->module, id, class))
        return id;
    const uint32_t rounded = pass->next_id++;
    call_round(pass, pass->value[id].type, rounded, id, class);
    return rounded;
}

static uint32_t operand_end(const uint32_t *word, const struct sb_operation *operation)
{
    const uint32_t length = sb_spirv_length(word);
    const uint32_t end = operation->first + (uint32_t)operation->count;
    return operation->count == SB_ALL_OPERANDS || end > length ? length : end;
}

// The lowest class of the operands that are not constant.
static enum sb_class class_of_operands(const struct pass *pass, const uint32_t *word,
                                       const struct sb_operation *operation)
{
    enum sb_class class = SB_NO_CLASS;
    for (uint32_t i = operation->first; i < operand_end(word, operation); i++)
        if (is_float(pass, word[i]))
            class = lower(class, pass->value[word[i]].class);
    return class;
}

// The instruction with its operands rounded to the class, in pass->patched.
static uint32_t *patch(struct pass *pass, const uint32_t *word,
                       const struct sb_operation *operation, enum sb_class class)
{
    pass->patched.count = 0;
    sb_words_copy(&pass->patched, word, sb_spirv_length(word));
    for (uint32_t i = operation->first; i < operand_end(word, operation); i++)
        pass->patched.word[i] = operand(pass, word[i], class);
    return pass->patched.word;
}

static void copy(struct pass *pass, const uint32_t *word)
{
    sb_words_copy(&pass->out, word, sb_spirv_length(word));
}

// Writes an instruction so that its result is rounded.
static void copy_rounded(struct pass *pass, const uint32_t *word, enum sb_class class)
{
    const uint32_t plain = pass->next_id++;
    const size_t at = pass->out.count;
    const uint32_t type = word[1], result = word[2];
    copy(pass, word);
    pass->out.word[at + 2] = plain;
    call_round(pass, type, result, plain, class);
    pass->rounded++;
}

static bool expand(struct pass *pass, const uint32_t *word,
                   const struct sb_operation *operation, enum sb_class class)
{
    uint32_t type[3];
    for (int i = 0; i < operation->count; i++)
        type[i] = pass->value[word[operation->first + i]].type;
    const uint32_t function =
        function_of(pass, operation->function, class, type, operation->count);
    if (!function)
        return false;
    const uint32_t *patched = patch(pass, word, operation, class);
    call(pass, word[1], word[2], function, &patched[operation->first], operation->count);
    pass->rounded++;
    return true;
}

static void operate(struct pass *pass, const uint32_t *word,
                    const struct sb_operation *operation)
{
    struct value *result = &pass->value[word[2]];
    const bool exact = operation->kind == SB_MOVE || operation->kind == SB_CHANGE;
    result->type = word[1];
    enum sb_class class = pass->module->id[word[2]].declared;
    if (class == SB_HIGHP && (exact || operation->kind == SB_COMPARE))
        class = class_of_operands(pass, word, operation);
    result->class = class;
    const bool reduced = class == SB_MEDIUMP || class == SB_LOWP;
    if (!reduced || operation->kind == SB_COPY ||
        (operation->kind != SB_COMPARE && !is_float(pass, word[2])))
        copy(pass, word);
    else if (operation->kind == SB_EXPAND && expand(pass, word, operation, class))
        return;
    else if (exact ? operation->kind == SB_CHANGE && class == SB_LOWP
                   : operation->kind != SB_COMPARE)
        copy_rounded(pass, patch(pass, word, operation, class), class);
    else
        copy(pass, patch(pass, word, operation, class));
}

// From a type along places, which are constants (ids) or literals: what the precision of the
// member is that they lead to, else `class`.
static enum sb_class class_at(const struct pass *pass, uint32_t type,
                              const uint32_t *place, uint32_t places, bool literal,
                              enum sb_class class)
{
    for (uint32_t i = 0; i < places; i++) {
        const uint32_t *word = &pass->module->word[pass->module->id[type].at];
        uint32_t member = place[i];
        if (sb_spirv_op(word) != SpvOpTypeStruct) {
            type = word[2]; // the element of an array, vector or matrix
            continue;
        }
        if (!literal)
            sb_module_constant(pass->module, place[i], &member);
        class = sb_module_member(pass->module, type, member);
        type = word[2 + member];
    }
    return class;
}

static uint32_t pointed(const struct pass *pass, uint32_t pointer)
{
    return pass->module->word[pass->module->id[pass->value[pointer].type].at + 3];
}

static void chain(struct pass *pass, const uint32_t *word)
{
    const struct value *base = &pass->value[word[3]];
    pass->value[word[2]] = (struct value){
        .type = word[1],
        .root = base->root,
        .class = class_at(pass, pointed(pass, word[3]), &word[4],
                          sb_spirv_length(word) - 4, false, base->class),
    };
    copy(pass, word);
}

// Whether every value in the variable has been rounded when it was stored. Not so in what comes
// from outside, has an initial value, or is stored as a whole with other members.
static bool is_kept_rounded(const struct pass *pass, uint32_t root)
{
    struct sb_shape shape;
    const uint32_t *word = &pass->module->word[pass->module->id[root].at];
    if (!sb_module_shape(pass->module, pointed(pass, root), &shape))
        return false;
    if (sb_spirv_op(word) == SpvOpFunctionParameter)
        return pass->value[root].class != SB_LOWP; // glslang's copies count as mediump
    return sb_spirv_length(word) == 4 &&
           (word[3] == SpvStorageClassFunction || word[3] == SpvStorageClassPrivate ||
            word[3] == SpvStorageClassOutput);
}

static void load(struct pass *pass, const uint32_t *word)
{
    struct value *result = &pass->value[word[2]];
    const struct value *pointer = &pass->value[word[3]];
    result->type = word[1];
    if (!is_float(pass, word[2])) {
        copy(pass, word);
        return;
    }
    enum sb_class class = pointer->class;
    if (class == SB_HIGHP)
        class = pass->module->id[word[2]].declared;
    result->class = class;
    if (class == SB_HIGHP ||
        (pointer->class != SB_HIGHP && is_kept_rounded(pass, pointer->root)))
        copy(pass, word);
    else
        copy_rounded(pass, word, class);
}

// An instruction without result whose operand at `place` goes into something of that class.
static void hand_over(struct pass *pass, const uint32_t *word, uint32_t place,
                      enum sb_class class)
{
    const uint32_t value = operand(pass, word[place], class);
    const size_t at = pass->out.count;
    if (value != word[place] && pass->value[word[place]].class != SB_NO_CLASS)
        pass->rounded++;
    copy(pass, word);
    pass->out.word[at + place] = value;
}

static void extract(struct pass *pass, const uint32_t *word)
{
    struct value *result = &pass->value[word[2]];
    result->type = word[1];
    result->class = pass->value[word[3]].class;
    if (is_float(pass, word[3]) || !is_float(pass, word[2])) {
        copy(pass, word);
        return;
    }
    result->class =
        class_at(pass, pass->value[word[3]].type, &word[4], sb_spirv_length(word) - 4,
                 true, pass->module->id[word[2]].declared);
    if (result->class == SB_HIGHP)
        copy(pass, word);
    else
        copy_rounded(pass, word, result->class);
}

// Members and elements are rounded when they are read.
static void construct(struct pass *pass, const uint32_t *word,
                      const struct sb_operation *operation)
{
    pass->value[word[2]].type = word[1];
    if (is_float(pass, word[2]))
        operate(pass, word, operation);
    else
        copy(pass, word);
}

// Arguments handed over as values; the others are in variables of the parameter's class.
static void call_source(struct pass *pass, const uint32_t *word)
{
    const struct sb_module *module = pass->module;
    const uint32_t *at = &module->word[module->id[word[3]].at];
    pass->patched.count = 0;
    sb_words_copy(&pass->patched, word, sb_spirv_length(word));
    for (uint32_t i = 4; i < sb_spirv_length(word); i++) {
        at += sb_spirv_length(at);
        pass->patched.word[i] = operand(pass, word[i], module->id[at[2]].declared);
    }
    copy(pass, pass->patched.word);
    pass->value[word[2]] =
        (struct value){.type = word[1], .class = module->id[word[3]].declared};
}

static void instruction(struct pass *pass, const uint32_t *word)
{
    const struct sb_operation *operation;
    switch (sb_spirv_op(word)) {
    case SpvOpFunction:
        pass->returns = pass->module->id[word[2]].declared;
        copy(pass, word);
        break;
    case SpvOpAccessChain:
    case SpvOpInBoundsAccessChain:
        chain(pass, word);
        break;
    case SpvOpLoad:
        load(pass, word);
        break;
    case SpvOpStore:
        hand_over(pass, word, 2, pass->value[word[1]].class);
        break;
    case SpvOpReturnValue:
        hand_over(pass, word, 1, pass->returns);
        break;
    case SpvOpFunctionCall:
        call_source(pass, word);
        break;
    case SpvOpCompositeExtract:
        extract(pass, word);
        break;
    default:
        operation = sb_operation_of(word, pass->module->extensions);
        if (!operation)
            copy(pass, word);
        else if (operation->op == SpvOpCompositeConstruct)
            construct(pass, word, operation);
        else
            operate(pass, word, operation);
    }
}

// What stands before the functions is known beforehand, and so are parameters and variables.
static void begin(struct pass *pass, struct sb_arena *arena)
{
    const struct sb_module *module = pass->module;
    pass->next_id = module->bound;
    pass->value = sb_arena_alloc(arena, module->bound * sizeof *pass->value);
    pass->function = sb_arena_alloc(arena, module->bound * sizeof *pass->function);
    for (uint32_t id = 1; id < module->bound; id++) {
        const struct sb_id *known = &module->id[id];
        const uint32_t op = known->at ? sb_spirv_op(&module->word[known->at]) : 0;
        const bool stored = op == SpvOpVariable || op == SpvOpFunctionParameter;
        pass->value[id] = (struct value){
            .type = known->type,
            .root = id,
            .class = stored        ? known->declared
                     : known->type ? SB_NO_CLASS
                                   : SB_HIGHP,
        };
        if (op == SpvOpFunction && known->name && strncmp(known->name, "sb_", 3) == 0)
            pass->function[pass->functions++] = (struct function){known->name, id};
    }
}

void sb_module_round(const struct sb_module *module, bool bindings,
                     struct sb_arena *arena, struct sb_rounding *rounding)
{
    struct pass pass = {.module = module};
    bool called = false;
    begin(&pass, arena);
    sb_module_rename(module, bindings, &pass.out);
    for (size_t i = module->body; i < module->count;
         i += sb_spirv_length(&module->word[i])) {
        const uint32_t *word = &module->word[i];
        if (sb_spirv_op(word) == SpvOpFunction)
            called = module->id[word[2]].called;
        if (called)
            instruction(&pass, word);
        else
            copy(&pass, word);
    }
    pass.out.word[3] = pass.next_id;
    rounding->rounded = pass.rounded;
    rounding->spirv.count = pass.out.count;
    rounding->spirv.word =
        sb_arena_alloc(arena, pass.out.count * sizeof *rounding->spirv.word);
    memcpy(rounding->spirv.word, pass.out.word,
           pass.out.count * sizeof *rounding->spirv.word);
    sb_words_free(&pass.out);
    sb_words_free(&pass.patched);
}
