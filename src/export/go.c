// Go's benchmark text (golang.org/design/14313-benchmark-format), a line a sample, with the units'
// metadata of golang.org/issue/43744.
//
// benchstat makes a table of its own for each set of configuration lines, so what differs between
// runs that are to be compared (SB_EXPORT_ONCE) stands in lines that it passes over.
#include <ctype.h>
#include <math.h>

#include "base/utf8.h"
#include "export/formats.h"

// Code points that end a field or a line (unicode.IsSpace).
static bool is_space(int32_t code)
{
    return code <= ' ' || code == 0x7F || code == 0x85 || code == 0xA0 ||
           code == 0x1680 || (code >= 0x2000 && code <= 0x200A) || code == 0x2028 ||
           code == 0x2029 || code == 0x202F || code == 0x205F || code == 0x3000;
}

static void add_line(struct sb_text *text, const char *value)
{
    struct sb_text clean = {0};
    sb_utf8_add(&clean, value);
    for (const char *at = sb_text_get(&clean); *at; at++)
        sb_text_add_n(text, (unsigned char)*at < ' ' ? " " : at, 1);
    sb_text_add(text, "\n");
    sb_text_free(&clean);
}

static void add_properties(const struct sb_export *export, struct sb_text *text)
{
    sb_text_add(text, "# ");
    add_line(text, export->name);
    for (int i = 0; i < export->property_count; i++) {
        const struct sb_export_property *property = &export->property[i];
        if (!property->value || !property->value[0])
            continue;
        if (property->flags & SB_EXPORT_ONCE)
            sb_text_add(text, "# ");
        sb_text_printf(text, "%s: ", property->name);
        add_line(text, property->value);
    }
    sb_text_add(text, "Unit ns/op better=lower\nUnit cpu-ns/op better=lower\n");
    for (int i = 0; i < export->row_count; i++)
        if (isfinite(sb_export_instructions(&export->row[i]))) {
            sb_text_add(text, "Unit Ir/op better=lower\n");
            return;
        }
}

// An id as the parts of a name: "/point=8/stage=fragment", which benchstat knows as keys. A slash
// within a value would begin another part.
static void add_parts(struct sb_text *text, const char *string)
{
    struct sb_text clean = {0};
    sb_utf8_add(&clean, string);
    for (const char *at = sb_text_get(&clean); *at;) {
        const char *from = at;
        const int32_t code = sb_utf8_next(&at);
        if (code == ',')
            sb_text_add(text, "/");
        else if (is_space(code) || code == '/')
            sb_text_add(text, "_");
        else
            sb_text_add_n(text, from, (size_t)(at - from));
    }
    sb_text_free(&clean);
}

// "BenchmarkRoom/point=8/stage=fragment/side=head-1". The last part is taken for a number of
// processors where it ends in one, so one always stands there.
static void add_name(struct sb_text *text, const struct sb_export_row *row)
{
    sb_text_add(text, "Benchmark");
    const size_t first = text->length;
    add_parts(text, row->scene);
    if (text->length > first)
        text->data[first] = (char)toupper((unsigned char)text->data[first]);
    sb_text_add(text, "/");
    add_parts(text, row->variant);
    if (row->side) {
        sb_text_add(text, "/side=");
        add_parts(text, row->side);
    }
    sb_text_add(text, "-1");
}

static void add_value(struct sb_text *text, double value, const char *unit)
{
    if (!isfinite(value))
        return;
    sb_text_add(text, "\t");
    sb_export_number(text, value);
    sb_text_printf(text, " %s", unit);
}

struct values { // NAN: not known
    double ns, cpu_ns, instructions;
};

static void add_result(struct sb_text *text, const struct sb_export_row *row,
                       const struct values *values)
{
    add_name(text, row);
    sb_text_printf(text, "\t%d", row->batch > 0 ? row->batch : 1);
    add_value(text, values->ns, "ns/op");
    add_value(text, values->cpu_ns, "cpu-ns/op");
    add_value(text, values->instructions, "Ir/op"); // as callgrind calls them
    sb_text_add(text, "\n");
}

static double sample(const double *values, int i)
{
    return values ? values[i] : NAN;
}

void sb_export_go(const struct sb_export *export, struct sb_text *text)
{
    add_properties(export, text);
    for (int i = 0; i < export->row_count; i++) {
        const struct sb_export_row *row = &export->row[i];
        const double instructions = sb_export_instructions(row);
        if (!sb_export_timed(row) && !isfinite(instructions))
            continue;
        for (int s = 0; s < row->sample_count; s++)
            add_result(text, row,
                       &(struct values){sample(row->sample_ns, s),
                                        sample(row->sample_cpu_ns, s),
                                        sample(row->sample_instructions, s)});
        if (row->sample_count == 0)
            add_result(text, row,
                       &(struct values){row->frame_ns.point, row->cpu_ns, instructions});
    }
}
