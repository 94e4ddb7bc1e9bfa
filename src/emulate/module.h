// What a pass needs to know of a SPIR-V module: the type of each value, the names, and which
// precision the source declares. SPIR-V knows one reduced precision, RelaxedPrecision, for both
// mediump and lowp; what is still relaxed where the source says highp for mediump is lowp.
#pragma once

#include "emulate/compile.h"

// In this order: the smaller of two is the precision of an operation on both.
enum sb_class { SB_HIGHP, SB_MEDIUMP, SB_LOWP, SB_NO_CLASS /* of constants */ };

struct sb_member_class {
    uint32_t structure;
    uint32_t member;
    enum sb_class class;
};

struct sb_id {
    uint32_t at;            // the word where its definition begins; 0: not known
    uint32_t type;          // of a value; 0: none or not known
    const char *name;       // in the module; NULL: none
    enum sb_class declared; // of a value, a variable, or what a function returns
    bool called;            // a function: main, or main calls it
};

struct sb_module {
    const uint32_t *word;
    size_t count;
    uint32_t bound;      // ids are less
    uint32_t extensions; // the id of GLSL.std.450
    size_t body;         // where the functions begin
    struct sb_id *id;
    struct sb_member_class *member; // only those that are not highp
    int members;
};

// Both modules are of one source: `lowp` of that with highp for mediump; NULL: nothing is lowp.
// Everything lives in the arena or in the modules. SB_INTERNAL where they differ in more.
bool sb_module_read(const struct sb_spirv *spirv, const struct sb_spirv *lowp,
                    struct sb_arena *arena, struct sb_module *module,
                    struct sb_error *err);

// Words and opcode of the instruction at a word.
static inline uint32_t sb_spirv_length(const uint32_t *word)
{
    return *word >> 16;
}
static inline uint32_t sb_spirv_op(const uint32_t *word)
{
    return *word & 0xffff;
}

bool sb_spirv_relaxed(const uint32_t *word); // it decorates with RelaxedPrecision

enum { SB_SPIRV_HEAD = 5 };

// Columns and rows of a type of floats: 1, 1 a scalar; 1, 3 a vector. False: another type.
struct sb_shape {
    int columns, rows;
};
bool sb_module_shape(const struct sb_module *module, uint32_t type,
                     struct sb_shape *shape);

// The member of a structure by its place.
enum sb_class sb_module_member(const struct sb_module *module, uint32_t structure,
                               uint32_t member);

// A constant as a number of the program, for places and single floats.
bool sb_module_constant(const struct sb_module *module, uint32_t id, uint32_t *bits);
