#include <string.h>

#include "base/text.h"
#include "measure/precision.h"

static const char not_probed[] = "not probed";

// "base" or "base but term word, term word".
static const char *list(const struct sb_asked_precision *asked, const char *base,
                        const char *const word[SB_PRECISION_TERMS],
                        struct sb_arena *arena)
{
    struct sb_text text = {0};
    sb_text_add(&text, base);
    const size_t whole = text.length;
    for (int i = 0; i < SB_PRECISION_TERMS; i++)
        if (word[i] && strcmp(word[i], base) != 0)
            sb_text_printf(&text, "%s%s %s", text.length == whole ? " but " : ", ",
                           asked->term[i].name, word[i]);
    const char *kept = sb_arena_strdup(arena, sb_text_get(&text));
    sb_text_free(&text);
    return kept;
}

const char *sb_precision_requested(const struct sb_asked_precision *asked,
                                   struct sb_arena *arena)
{
    const char *word[SB_PRECISION_TERMS];
    int highest = asked->lowest;
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        word[i] = sb_precision_names[asked->term[i].precision];
        if (asked->term[i].precision < highest)
            highest = asked->term[i].precision;
    }
    return list(asked, sb_precision_names[highest], word, arena);
}

// What a term comes to. NULL: not probed at highp, of which nothing else is to be expected.
static const char *effective_word(const struct sb_asked_precision *asked,
                                  const struct sb_asked_term *term,
                                  const struct sb_driver *driver)
{
    if (asked->emulation != SB_EMULATED_NOT && term->declared > 0)
        return asked->emulation == SB_EMULATED_FIXED10 && term->declared == 2
                   ? "fixed10 emulated"
                   : "fp16 emulated";
    const struct sb_precision_verdict *verdict =
        sb_driver_precision(driver, term->vertex_stage, term->carrier, term->declared);
    if (!verdict || verdict->effective == SB_EFFECTIVE_UNKNOWN)
        return term->declared > 0 ? not_probed : NULL;
    return sb_effective_names[verdict->effective];
}

// The word that most terms have, the first of equals; NULL where none was probed.
static const char *most_common(const char *const word[SB_PRECISION_TERMS])
{
    const char *best = NULL;
    int most = 0;
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        int count = 0;
        for (int k = 0; word[i] && k < SB_PRECISION_TERMS; k++)
            count += word[k] && strcmp(word[k], word[i]) == 0;
        if (count > most && word[i] != not_probed) {
            most = count;
            best = word[i];
        }
    }
    return best;
}

// All that was asked for below highp, ignored.
static const char *all_ignored(const struct sb_asked_precision *asked,
                               struct sb_arena *arena)
{
    bool any[SB_PRECISION_COUNT] = {false};
    for (int i = 0; i < SB_PRECISION_TERMS; i++)
        any[asked->term[i].declared] = true;
    return sb_arena_printf(arena, "fp32 (%s%s%s ignored)", any[1] ? "mediump" : "",
                           any[1] && any[2] ? ", " : "", any[2] ? "lowp" : "");
}

const char *sb_precision_effective(const struct sb_asked_precision *asked,
                                   const struct sb_driver *driver, struct sb_arena *arena)
{
    const char *word[SB_PRECISION_TERMS];
    bool lowered = false, wide = false, full = true;
    for (int i = 0; i < SB_PRECISION_TERMS; i++) {
        const struct sb_asked_term *term = &asked->term[i];
        word[i] = effective_word(asked, term, driver);
        *(term->declared > 0 ? &lowered : &wide) = true;
        full &= !word[i] || strcmp(word[i], "fp32") == 0;
    }
    if (asked->emulation != SB_EMULATED_NOT && !wide)
        return asked->emulation == SB_EMULATED_FP16
                   ? "fp16 emulated"
                   : "fp16 emulated, lowp fixed10 emulated";
    const char *base = most_common(word);
    if (!base)
        return NULL;
    if (full && lowered)
        return all_ignored(asked, arena);
    return list(asked, base, word, arena);
}
