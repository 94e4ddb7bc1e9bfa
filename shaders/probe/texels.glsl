// What the maps gave to a fragment, wherever it is lit. All else may have been told before a map
// is read, so this page is told last, in place of what stands there.
#include "probe/page.glsl"
#include "probe/fragment.glsl"

#define MAP_DIFFUSE  0
#define MAP_SPECULAR 1
#define MAP_NORMAL   2

highp mat3x4 probe_maps = mat3x4(0.0);

void probe_pixel_tell()
{
    if (u_probe_page == 3)
        probe_out(probe_maps);
}

#define PROBE_MAP(number, texel) probe_put(probe_maps, 3 * number, texel);
#define PROBE_PIXEL_OUT probe_pixel_tell();
