#include <string.h>

#include "base/text.h"
#include "base/words.h"

static int edit_distance(const char *a, const char *b)
{
    enum { MAX = 63 };
    int row[MAX + 1];
    const int n = (int)strlen(b);
    if (n > MAX || strlen(a) > MAX)
        return MAX;
    for (int j = 0; j <= n; j++)
        row[j] = j;
    for (int i = 1; a[i - 1]; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= n; j++) {
            int best = diagonal + (a[i - 1] != b[j - 1]);
            if (row[j] + 1 < best)
                best = row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            diagonal = row[j];
            row[j] = best;
        }
    }
    return row[n];
}

const char *sb_nearest_word(const char *word, const char *const *candidates, int count)
{
    const char *nearest = NULL;
    int best = (int)strlen(word) / 3 + 1;
    for (int i = 0; i < count; i++) {
        const int distance = edit_distance(word, candidates[i]);
        if (distance <= best && (!nearest || distance < best)) {
            best = distance;
            nearest = candidates[i];
        }
    }
    return nearest;
}

bool sb_fail_unknown(struct sb_error *err, const char *owner, const char *what,
                     const char *word, const char *const *valid, int count)
{
    struct sb_text text = {0};
    if (*owner)
        sb_text_printf(&text, "%s: ", owner);
    sb_text_printf(&text, "unknown %s \"%s\";", what, word);
    const char *nearest = sb_nearest_word(word, valid, count);
    if (nearest)
        sb_text_printf(&text, " did you mean \"%s\"?", nearest);
    sb_text_add(&text, count ? " valid:" : " there are none");
    for (int i = 0; i < count; i++)
        sb_text_printf(&text, " %s", valid[i]);
    sb_fail(err, SB_BAD_INPUT, "%s", sb_text_get(&text));
    sb_text_free(&text);
    return false;
}
