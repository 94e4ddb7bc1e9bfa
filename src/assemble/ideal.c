#include "assemble/assemble.h"

void sb_caps_ideal(bool gles, struct sb_caps *caps)
{
    *caps = (struct sb_caps){
        .context = "null",
        .vendor = "none",
        .renderer = "ideal",
        .gles = gles,
        .api_version = gles ? 320 : 460,
        .glsl = gles ? 320 : 460,
        .vertex_uniform_components = 65536,
        .fragment_uniform_components = 65536,
        .uniform_block_size = 65536,
        .varying_components = 128,
        .texture_units = 32,
        .combined_texture_units = 192,
        .texture_size = 16384,
        .cube_map_size = 16384,
        .array_layers = 2048,
        .renderbuffer_size = 16384,
        .samples = 32,
        .colour_float = 1,
        .colour_half = 1,
        .elapsed_bits = 64,
        .timestamp_bits = 64,
        .disjoint = gles,
        .samples_passed = !gles,
        .program_binary = 1,
        .geometry_shader = 1,
        .cube_map_array = 1,
    };
}
