#include "emulate/rename.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <spirv.h>

void sb_words_copy(struct sb_word_list *list, const uint32_t *word, size_t count)
{
    if (list->capacity < list->count + count) {
        list->capacity = 2 * (list->count + count);
        list->word = sb_realloc(list->word, list->capacity * sizeof *list->word);
    }
    memcpy(list->word + list->count, word, count * sizeof *word);
    list->count += count;
}

void sb_words_add(struct sb_word_list *list, uint32_t word)
{
    sb_words_copy(list, &word, 1);
}

void sb_words_free(struct sb_word_list *list)
{
    free(list->word);
    *list = (struct sb_word_list){0};
}

// The structure of a block without instance name; 0: the id is something else.
static uint32_t unnamed_block(const struct sb_module *module, uint32_t id)
{
    const struct sb_id *variable = &module->id[id];
    const uint32_t *word = &module->word[variable->at];
    if (!variable->at || !variable->name || *variable->name ||
        sb_spirv_op(word) != SpvOpVariable ||
        (word[3] != SpvStorageClassUniform && word[3] != SpvStorageClassStorageBuffer))
        return 0;
    return module->word[module->id[variable->type].at + 3];
}

// Members of such blocks are global names, which a local one could hide.
static bool is_member_name(const struct sb_module *module, const char *name)
{
    for (size_t i = SB_SPIRV_HEAD; i < module->body;
         i += sb_spirv_length(&module->word[i])) {
        const uint32_t *word = &module->word[i];
        if (sb_spirv_op(word) != SpvOpMemberName ||
            strcmp((const char *)&word[3], name) != 0)
            continue;
        for (uint32_t id = 1; id < module->bound; id++)
            if (unnamed_block(module, id) == word[1])
                return true;
    }
    return false;
}

static void name_block(struct sb_word_list *out, uint32_t id)
{
    char text[24] = "";
    const uint32_t words = sizeof text / sizeof *out->word;
    uint32_t packed[sizeof text / sizeof *out->word];
    snprintf(text, sizeof text, SB_UNNAMED_BLOCK "%u", id);
    memcpy(packed, text, sizeof text);
    sb_words_add(out, (2 + words) << 16 | SpvOpName);
    sb_words_add(out, id);
    sb_words_copy(out, packed, words);
}

static bool is_binding(const uint32_t *word)
{
    return sb_spirv_op(word) == SpvOpDecorate && word[2] == SpvDecorationBinding;
}

void sb_module_rename(const struct sb_module *module, bool bindings,
                      struct sb_word_list *out)
{
    sb_words_copy(out, module->word, SB_SPIRV_HEAD);
    for (size_t i = SB_SPIRV_HEAD; i < module->body;
         i += sb_spirv_length(&module->word[i])) {
        const uint32_t *word = &module->word[i];
        const bool name = sb_spirv_op(word) == SpvOpName;
        if (name && unnamed_block(module, word[1]))
            name_block(out, word[1]);
        else if (!sb_spirv_relaxed(word) && (bindings || !is_binding(word)) &&
                 !(name && is_member_name(module, (const char *)&word[2])))
            sb_words_copy(out, word, sb_spirv_length(word));
    }
}
