// The part of a module in front of its functions, without precisions and with names for what has
// none; and the growing list of words that it is written to.
#pragma once

#include "emulate/module.h"

struct sb_word_list { // zero-initialise; sb_words_free
    uint32_t *word;
    size_t count, capacity;
};
void sb_words_add(struct sb_word_list *list, uint32_t word);
void sb_words_copy(struct sb_word_list *list, const uint32_t *word, size_t count);
void sb_words_free(struct sb_word_list *list);

// Appends everything up to module->body. A block without instance name gets one that begins with
// SB_UNNAMED_BLOCK, since SPIR-V has no such blocks; no other name is that of a member of one.
// Without `bindings`, those that glslang gave are left out.
#define SB_UNNAMED_BLOCK "sb_unnamed_"
void sb_module_rename(const struct sb_module *module, bool bindings,
                      struct sb_word_list *out);
