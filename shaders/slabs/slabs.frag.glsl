#include "formulas/kernel_moment.fx.h"
#include "formulas/kernel_quantile.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/henyey_greenstein.fx.h"
#if FX_NETWORK
#include "formulas/network_cell.fx.h"
#endif
#include "formulas/slab_light.fx.h"
#include "shared/view_block.glsl"
#include "shared/card_nodes.glsl"
#include "shared/unrolled.glsl"
#include "shared/light_slices.glsl"
#if FX_BLOCKS
#include "formulas/multiple_scattering.fx.h"
#include "shared/scattered_light.glsl"
#include "shared/sky_light.glsl"
#endif
#include "slabs/slab_balls.glsl"
#include "slabs/slab_ray.glsl"
#include "slabs/slab_sums.glsl"
#include "slabs/slab_window.glsl"
#if FX_FIELD_DETAIL
#include "field/field_blocks.glsl"
#include "field/field_detail.glsl"
#endif

// All media along one ray, summed up in FX_SLABS slabs and put together front to back, premultiplied. FX_GROUP slabs are filled
// at a time: fewer take fewer registers, but each group reads all balls again (SlabPass::maxOfTile counts that).
#if FX_FIELD_DETAIL || FX_LAYERS && !FX_BALL_DETAIL
#if FX_SLABS == 6
#define FX_GROUP 3
#else
#define FX_GROUP 4
#endif
#else
#define FX_GROUP FX_SLABS
#endif
#include "slabs/slab_fill.glsl"

void main()
{
    SlabRay ray = slabRay();
    ray.cards = firstCard();
    vec2 range = rangeOf(ray);
    if (!(range.y > range.x))
        discard;
    SlabWindow window = windowOf(ray, range);
    float end = window.depth < kMaxDepth ? range.y : window.ends.y; // the little before and behind the window is of the outer slabs

    SlabPicture picture = emptyPicture();
    float behind = 0.0; // [1] optical depth behind the window: it hides, and its light is not seen
#if FX_FIELD_DETAIL
    int slabs = tileList.y >= 0 ? FX_SLABS : 0; // not unrolled
#else
    const int slabs = FX_SLABS;
#endif
    for (int first = 0; first < slabs && picture.through > kMinTransmittance; first += kGroup) {
        float edges[kGroup + 1];
        for (int k = 0; k <= kGroup; ++k) {
            int edge = first + k;
            edges[k] = edge == 0 ? range.x : edge == FX_SLABS ? end : placeAt(window, float(edge) / float(FX_SLABS));
        }
        SlabSums sums[kGroup];
        for (int k = 0; k < kGroup; ++k)
            sums[k] = emptySlab();
        addLoose(ray, edges, window.ends, range.y, sums, behind);
        for (int k = 0; k < kGroup; ++k)
            putBehind(picture, sums[k], edges[k], edges[k + 1]);
    }
    hide(picture, behind);
    writePicture(picture);
}
