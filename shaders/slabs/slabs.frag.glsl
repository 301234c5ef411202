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
#include "shared/smooth_light.glsl"
#if FX_NETWORK
#include "field/field_glow.glsl"
#include "network/network_grid.glsl"
#include "network/network_gather.glsl"
#endif
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

const float kSlabs = float(FX_SLABS);

// The face before a slab. end: of the last; what is behind the window counts as one more
float faceOf(SlabWindow window, vec2 range, float end, float slab)
{
    if (slab > kSlabs)
        return range.y;
    return slab == 0.0 ? range.x : slab == kSlabs ? end : placeAt(window, slab / kSlabs);
}

// Slabs between which the ray is drawn, counted from the first; a fraction is a share of the optical depth of one.
vec2 drawnSlabs(SlabRay ray, SlabWindow window, vec2 range, float end)
{
    vec2 slabs = vec2(0.0, kSlabs + 1.0);
    for (int once = 0; once < (isCut(ray) ? 1 : 0); ++once) { // software renderers skip a loop without turns
        float places[6], passed[6];
        for (int k = 0; k < 2; ++k) {
            float place = clamp(ray.drawn[k], range.x, range.y);
            slabs[k] = place > end ? kSlabs : slabAt(window, place, kSlabs);
            places[3 * k] = faceOf(window, range, end, slabs[k]);
            places[3 * k + 1] = place;
            places[3 * k + 2] = faceOf(window, range, end, slabs[k] + 1.0);
        }
        passedUpTo(ray, places, passed);
        for (int k = 0; k < 2; ++k)
            slabs[k] += shareBetween(passed[3 * k], passed[3 * k + 1], passed[3 * k + 2]);
        const float kAll = kSlabs + 1.0;
        slabs.x = ray.drawn.x > range.x ? (ray.drawn.x < range.y ? slabs.x : kAll) : 0.0;
        slabs.y = ray.drawn.y < range.y ? (ray.drawn.y > range.x ? slabs.y : 0.0) : kAll;
    }
    return slabs;
}

void main()
{
    SlabRay ray = slabRay();
    ray.cards = firstCard();
    vec2 range = rangeOf(ray);
    if (!(range.y > range.x))
        discard;
    SlabWindow window = windowOf(ray, range);
    float end = window.depth < kMaxDepth ? range.y : window.ends.y; // the little before and behind the window is of the outer slabs

    vec2 drawn = drawnSlabs(ray, window, range, end);
    SlabPicture picture = emptyPicture();
    float behind = 0.0; // [1] optical depth behind the window: it hides, and its light is not seen
#if FX_FIELD_DETAIL
    int slabs = tileList.y >= 0 ? FX_SLABS : 0; // not unrolled
#else
    const int slabs = FX_SLABS;
#endif
    for (int first = 0; first < slabs && float(first) < drawn.y && picture.passed < kLastDepth; first += kGroup) {
        float edges[kGroup + 1];
        for (int k = 0; k <= kGroup; ++k)
            edges[k] = faceOf(window, range, end, float(first + k));
        SlabSums sums[kGroup];
        for (int k = 0; k < kGroup; ++k)
            sums[k] = emptySlab();
        addLoose(ray, edges, window.ends, range.y, sums, behind);
        for (int k = 0; k < kGroup; ++k)
            putBehind(picture, sums[k], edges[k], edges[k + 1], clamp(drawn - float(first + k), 0.0, 1.0));
    }
    drawn = clamp(drawn - kSlabs, 0.0, 1.0);
    hide(picture, (drawn.y - drawn.x) * behind);
    writePicture(picture);
}
