// Balls of one field with detail, summed up in slabs and eroded there: the noise of field/field_detail.glsl at one place of each
// slab. Included by slabs/slab_fill.glsl. Needs field/field_blocks.glsl and field/field_detail.glsl.
struct DetailedSlab
{
    SlabSums whole;     // smooth; of light what is scattered
    vec3 emitted;       // as light and slope of SlabSums
    vec3 emittedSlope;
    vec3 carried0;      // [cell] depth times coordinates of the generations
    vec4 carried1;      // w depth times thinning
    vec2 power;         // x light times the power of temperature by which it follows the detail; y light
};

DetailedSlab emptyDetailedSlab()
{
    DetailedSlab slab;
    slab.whole = emptySlab();
    slab.emitted = slab.emittedSlope = slab.carried0 = vec3(0.0);
    slab.carried1 = vec4(0.0);
    slab.power = vec2(0.0);
    return slab;
}

// carried0, carried1: texels of the ball
void addDetailedBall(inout DetailedSlab slab, BallLight ball, float layers, float depth, float moment, vec3 scattered, vec3 carried0,
                     vec4 carried1, float power)
{
    vec3 emitted = ball.emitted;
    ball.emitted = vec3(0.0);
    addBall(slab.whole, ball, layers, depth, moment, scattered);
    slab.emitted += depth * emitted;
    slab.emittedSlope += moment * emitted;
    slab.carried0 += depth * carried0;
    slab.carried1 += depth * carried1;
    slab.power += depth * (emitted.r + emitted.g + emitted.b) * vec2(power, 1.0);
}

// A slab of a group that is not a constant: software renderers choose faster than they look up.
vec4 chosen(int k, vec4 of[4]) { return k < 2 ? (k < 1 ? of[0] : of[1]) : (k < 3 ? of[2] : of[3]); }

// Share of the extinction that detail leaves in each slab, and the temperature over that of the smooth field. The loop is not
// unrolled: the noise is long.
void detailOfSlabs(SlabRay ray, float edges[kGroup + 1], FieldDetail numbers, DetailedSlab slabs[kGroup], out vec4 shares,
                   out vec4 temperatures)
{
    vec4 bodies[4], carried0[4], carried1[4]; // x depth; y moment; z middle; w length [m]
    for (int k = 0; k < 4; ++k) {
        int slab = min(k, kGroup - 1);
        bodies[k] = vec4(slabs[slab].whole.depth, slabs[slab].whole.moment, 0.5 * (edges[slab] + edges[slab + 1]),
                         edges[slab + 1] - edges[slab]);
        carried0[k] = vec4(slabs[slab].carried0, slabs[slab].power.y);
        carried1[k] = slabs[slab].carried1;
    }
    shares = temperatures = vec4(1.0);
    int turns = tileList.y > 0 ? kGroup : 0;
    for (int k = 0; k < turns; ++k) {
        vec4 body = chosen(k, bodies);
        if (body.x > 1e-12) { // its inverse and that times a moment are finite
            float perDepth = 1.0 / body.x;
            float t = body.z + perDepth * body.y * body.w; // where most of the medium is
            vec4 first = chosen(k, carried0), second = perDepth * chosen(k, carried1);
            DetailPlace place = detailPlace(numbers.erosion, numbers.soft, body.x / max(body.w, 1e-20), second.w);
            float pixel = rayOrigin.w > 0.5 ? 1.0 / sunDirection.w : t / (ray.lengthPerDepth * sunDirection.w);
            MediumDetail detail = detailOf(numbers, place, ray.origin + t * ray.direction, perDepth * first.xyz, second.xyz,
                                           max(pixel, kPixelOfLength * body.w), first.w > 0.0);
            bvec4 isThis = equal(ivec4(k), ivec4(0, 1, 2, 3));
            shares = mix(shares, vec4(detail.share), isThis);
            temperatures = mix(temperatures, vec4(detail.temperature), isThis);
        }
    }
}

// Adds what detail leaves of the balls of one field to the sums, and empties theirs. first: texel of the detail
void addEroded(SlabRay ray, float edges[kGroup + 1], int first, inout DetailedSlab slabs[kGroup], inout SlabSums sums[kGroup])
{
    vec4 shares, temperatures;
    detailOfSlabs(ray, edges, fieldDetail(first), slabs, shares, temperatures);
    for (int k = 0; k < kGroup; ++k) {
        DetailedSlab slab = slabs[k];
        slabs[k] = emptyDetailedSlab();
        float share = shares[k];
        vec3 glow = detailedLight(vec3(share), MediumDetail(share, temperatures[k], true), slab.power.x / max(slab.power.y, 1e-20));
        sums[k].depth += share * slab.whole.depth;
        sums[k].moment += share * slab.whole.moment;
        for (int l = 0; l < kLayers; ++l) {
            sums[k].light[l] += share * slab.whole.light[l];
            sums[k].slope[l] += share * slab.whole.slope[l];
        }
        sums[k].light[0] += glow * slab.emitted;
        sums[k].slope[0] += glow * slab.emittedSlope;
#if FX_LAYERS
        sums[k].share += share * slab.whole.share;
#endif
    }
}
