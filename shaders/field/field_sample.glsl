// The sum of all fields of a tile at a place, and of what lies between two places. Needs field/field_blocks.glsl and
// slabs/slab_sums.glsl.
layout(binding = 12) uniform sampler2D brickTable;
layout(binding = 1) uniform sampler3D fieldMedium; // rgb emitted light [exposed/m]; a extinction [1/m]
#if FX_LAYERS || FX_DETAIL
layout(binding = 2) uniform sampler3D fieldScatter; // rgb scattered light over the field's largest extinction [exposed]
#endif
#if FX_DETAIL
layout(binding = 4) uniform sampler3D fieldMaterial0; // rgb, as field_fill.comp.glsl; a power of temperature of what is emitted
layout(binding = 5) uniform sampler3D fieldMaterial1; // a thinning
#endif
#if FX_LAYERS
layout(binding = 3) uniform sampler3D fieldShares;  // extinction seen as fire, as dust; of balls of fire, of dust; likewise
#endif

const float kVoxelsPerStep = 1.5; // more exact lookups than that change no picture: samples are what limits it
const float kVoxelsPerLumpyStep = 0.6; // where detail is finer than voxels
const float kNever = 1e20; // [m], [voxel]
const float kDepthPerStep = 0.4;     // optical depth of a step: in dense medium one or two samples would be all that is seen
const float kMinVoxelsPerStep = 0.1;

struct FieldSample
{
    vec4 medium; // rgb emitted light, without FX_LAYERS also what is scattered [exposed/m]; a extinction [1/m]
#if FX_LAYERS
    vec4 shares;    // [1/m]
    vec3 scattered; // [exposed/m]
#endif
    bool isEmpty; // no field has a brick here
    float room;   // [m] along the ray: one step, or up to where a brick may begin
};

// A place within a field, in voxels, and how a ray passes there.
struct FieldPlace
{
    vec3 local;  // from the first sample
    ivec3 brick;
    int number;  // of the brick + 1, or 0 where no ray sees any medium
    float room;  // [voxel] up to where a brick may begin, if there is none
};

FieldPlace placeInField(VoxelField field, vec3 p, vec3 perDirection)
{
    FieldPlace place;
    place.local = (p - field.corner.xyz) / field.corner.w;
    vec3 size = vec3(kBrickCells * field.bricks.xyz);
    bool isInside = all(greaterThanEqual(place.local, vec3(0.0))) && all(lessThan(place.local, size));
    place.brick = clamp(ivec3(floor(place.local / float(kBrickCells))), ivec3(0), field.bricks.xyz - 1);
    place.number = isInside ? max(int(texelFetch(brickTable, tableTexel(tableEntry(field, place.brick)), 0).r), 0) : 0;
    vec3 low = isInside ? vec3(kBrickCells * place.brick) : vec3(0.0);
    vec3 high = isInside ? low + float(kBrickCells) : size;
    vec3 a = (low - place.local) * perDirection;
    vec3 b = (high - place.local) * perDirection;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b);
    float first = max(max(enter.x, enter.y), enter.z);
    float last = min(min(leave.x, leave.y), leave.z);
    float entering = last > 0.0 && first <= last ? max(first, 0.0) : kNever; // 0: on a face, of which the far ones are outside
    place.room = (isInside ? max(last, 0.0) : entering) + 0.01; // beyond the face, whatever rounding does
    return place;
}

// @param t [m] along the ray; tile first texel of the list of fields, and how many; width of a pixel: pixel.x [1] t + pixel.y [m]
FieldSample sampleFields(vec3 origin, vec3 direction, float t, uvec2 tile, vec2 pixel)
{
    FieldSample sum;
    sum.medium = vec4(0.0);
#if FX_LAYERS
    sum.shares = vec4(0.0);
    sum.scattered = vec3(0.0);
#endif
    sum.isEmpty = true;
    sum.room = kNever;
    vec3 safe = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 p = origin + t * direction;
    for (uint k = tile.x; k < tile.x + tile.y; ++k) {
        VoxelField field = fieldOf(int(fieldTexel(int(k)).x));
        FieldPlace place = placeInField(field, p, 1.0 / safe);
        // a loop without turns is skipped by software renderers too, a branch is not
        int turns = place.number > 0 ? 1 : 0;
        for (int turn = 0; turn < turns; ++turn) {
            vec3 texel = vec3(brickTexel(place.number - 1)) + 0.5 + place.local - vec3(kBrickCells * place.brick);
            vec3 uv = texel / vec3(textureSize(fieldMedium, 0));
            vec4 medium = textureLod(fieldMedium, uv, 0.0);
            float kept = medium.a != 0.0 ? 1.0 : 0.0;
            float voxels = kVoxelsPerStep;
#if FX_DETAIL
            int detailed = field.limits.z > 0.5 ? 1 : 0;
            kept = detailed > 0 && medium.a <= 0.0 ? 0.0 : kept; // rims that are below 0 are eroded
            DetailPlace at;
            float perMedium = field.limits.y / medium.a;
            vec4 material1;
            detailed = kept == 0.0 ? 0 : detailed;
            for (int once = 0; once < detailed; ++once) {
                material1 = perMedium * textureLod(fieldMaterial1, uv, 0.0);
                int first = int(field.limits.z);
                at = detailPlace(fieldTexel(first + 6), fieldTexel(first + 9), medium.a, material1.a);
                kept = at.s > 0.0 ? 1.0 : 0.0;
            }
            detailed = kept == 0.0 ? 0 : detailed;
            for (int once = 0; once < detailed; ++once) {
                FieldDetail numbers = fieldDetail(int(field.limits.z));
                vec4 material0 = vec4(0.0);
                int lumpy = hasLumps(at) ? 1 : 0;
                for (int lump = 0; lump < lumpy; ++lump)
                    material0 = textureLod(fieldMaterial0, uv, 0.0);
                MediumDetail detail = detailOf(numbers, at, p, material0.rgb * perMedium, material1.rgb, pixel.x * t + pixel.y);
                kept = detail.share;
                voxels = detail.isLumpy ? kVoxelsPerLumpyStep : kVoxelsPerStep;
                medium.rgb = detailedLight(medium.rgb, detail, material0.a);
            }
#endif
#if FX_LAYERS || FX_DETAIL
            vec3 scattered = vec3(0.0);
            int scatters = kept != 0.0 ? 1 : 0;
            for (int once = 0; once < scatters; ++once)
                scattered = field.limits.y * textureLod(fieldScatter, uv, 0.0).rgb;
#endif
#if FX_LAYERS
            sum.scattered += kept * scattered;
            vec4 shares = vec4(0.0);
            for (int once = 0; once < scatters; ++once)
                shares = field.limits.y * textureLod(fieldShares, uv, 0.0);
            sum.shares += kept * shares;
#elif FX_DETAIL
            medium.rgb += scattered;
#endif
            sum.medium += kept * medium;
            sum.room = min(sum.room, field.corner.w * clamp(kDepthPerStep / (field.corner.w * max(kept * medium.a, 1e-20)), kMinVoxelsPerStep, voxels));
        }
        sum.isEmpty = sum.isEmpty && turns == 0;
        if (turns == 0)
            sum.room = min(sum.room, place.room < kNever ? field.corner.w * place.room : kNever);
    }
    return sum;
}

#if FX_LAYERS
// [exposed/m] light of fire, smoke and dust.
vec3[3] layersOf(FieldSample s)
{
    float perExtinction = abs(s.medium.a) > 1e-20 ? 1.0 / s.medium.a : 0.0;
    vec2 of = clamp(s.shares.zw * perExtinction, vec2(0.0), vec2(1.0));
    vec3 fire = of.x * s.scattered, dust = of.y * s.scattered;
    return vec3[3](s.medium.rgb + fire, s.scattered - fire - dust, dust);
}
#endif

// What fields hold between two samples of a ray, [m] apart: extinction and light are linear there. Rims may be below 0, see
// voxel-kernel; those of very dense balls are cut off, or they would make light.
SlabSums slabBetween(FieldSample near, FieldSample far, float apart)
{
    const float kMaxBelow = 0.02; // [1] optical depth
    float halfApart = near.isEmpty ? 0.0 : 0.5 * apart;
    halfApart *= min(kMaxBelow / max(-halfApart * (near.medium.a + far.medium.a), kMaxBelow), 1.0);
    const float kMoment = 0.166666666667;
    SlabSums sums;
    sums.depth = halfApart * (near.medium.a + far.medium.a);
    sums.moment = halfApart * kMoment * (far.medium.a - near.medium.a);
#if FX_LAYERS
    vec3 lights[2][3] = vec3[2][3](layersOf(near), layersOf(far));
    for (int l = 0; l < 3; ++l) {
        sums.light[l] = halfApart * (lights[0][l] + lights[1][l]);
        sums.slope[l] = halfApart * kMoment * (lights[1][l] - lights[0][l]);
    }
    vec4 shares = halfApart * (near.shares + far.shares);
    sums.share = vec3(shares.x, sums.depth - shares.x - shares.y, shares.y);
#else
    sums.light[0] = halfApart * (near.medium.rgb + far.medium.rgb);
    sums.slope[0] = halfApart * kMoment * (far.medium.rgb - near.medium.rgb);
#endif
    return sums;
}
