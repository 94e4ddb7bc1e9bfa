// GIVEN=rows, in the program "rows": what a point is lit by comes from a row of a table, one row
// a point, so that the formulas can be asked at any input. What is a varying, a uniform or a
// texel elsewhere is a global variable of the same name and precision.
#define GIVEN_INPUT
#define GIVEN_UNIFORM
#define GIVEN_MAP(name) P_SAMPLER vec4 name;
#undef TEXTURE
#define TEXTURE(map, uv) map

uniform highp sampler2D u_rows; // four floats of a row a texel
uniform highp int u_row_first;  // point number p takes row u_row_first + p * u_row_step
uniform highp int u_row_step;
highp int row_number;

void row_is(highp int point)
{
    row_number = min(u_row_first + point * u_row_step, textureSize(u_rows, 0).y - 1);
}

// Float number i of the row, and the vector that starts there.
highp float row_float(highp int i)
{
    return texelFetch(u_rows, ivec2(i >> 2, row_number), 0)[i & 3];
}

highp vec2 row_vec2(highp int i)
{
    return vec2(row_float(i), row_float(i + 1));
}

highp vec3 row_vec3(highp int i)
{
    return vec3(row_float(i), row_float(i + 1), row_float(i + 2));
}
