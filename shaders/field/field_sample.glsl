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

#if FX_DETAIL
#include "field/field_near.glsl"
const float kMostOfWhole = 4.0; // [1] extinction over that of which the textures hold the ratios, at most
#endif

const float kVoxelsPerStep = 1.5; // more exact lookups than that change no picture: samples are what limits it
const float kVoxelsPerVolumeStep = 1.0; // where voxels differ from their neighbors as much as a file says
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
    float most;   // [m] of a step that is made longer; kNever where the medium does not change within a voxel
};

// A place within a field, in voxels, and how a ray passes there.
struct FieldPlace
{
    vec3 local;  // from the first sample
    ivec3 brick;
    int number;  // of the brick + 1, or 0 where no ray sees any medium
    float room;  // [voxel] up to where a brick or an eighth of one may begin, if there is none
};

FieldPlace placeInField(VoxelField field, vec3 p, vec3 perDirection)
{
    FieldPlace place;
    place.local = (p - field.corner.xyz) / field.corner.w;
    vec3 size = vec3(kBrickCells * field.bricks.xyz);
    bool isInside = all(greaterThanEqual(place.local, vec3(0.0))) && all(lessThan(place.local, size));
    place.brick = clamp(ivec3(floor(place.local / float(kBrickCells))), ivec3(0), field.bricks.xyz - 1);
    float entry = isInside ? texelFetch(brickTable, tableTexel(tableEntry(field, place.brick)), 0).r : 0.0;
    vec3 low = isInside ? vec3(kBrickCells * place.brick) : vec3(0.0);
    vec3 eighth = step(low + float(kBrickCells / 2), place.local);
    int seen = int(256.0 * fract(entry)) >> int(dot(eighth, vec3(1.0, 2.0, 4.0))) & 1;
    place.number = entry > 0.0 ? seen * int(entry) : 0;
    low += entry > 0.0 ? float(kBrickCells / 2) * eighth : vec3(0.0);
    vec3 high = isInside ? low + float(entry > 0.0 ? kBrickCells / 2 : kBrickCells) : size;
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

const float kRounding = 3e-7; // of a distance along a ray
const uint kKnownFields = 4u; // of a tile, whose numbers a ray keeps
const int kKnownTexels = 12;  // three of each: NVIDIA's compiler takes no conversion in the size of a member

// A ray through the fields of a tile.
struct FieldRay
{
    vec3 origin;       // [m]
    vec3 direction;    // unit
    vec3 perDirection; // 1 / direction, finite
    uvec2 tile;        // first texel of the list of fields, and how many
    vec2 pixel;        // its width: pixel.x [1] t + pixel.y [m]
    vec4 rests;        // [m] up to where the known fields have no medium; they are not looked at before
    vec4 known[kKnownTexels]; // texels of the known fields
};

FieldRay fieldRay(vec3 origin, vec3 direction, uvec2 tile, vec2 pixel)
{
    FieldRay ray;
    vec3 safe = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    ray.origin = origin;
    ray.direction = direction;
    ray.perDirection = 1.0 / safe;
    ray.tile = tile;
    ray.pixel = pixel;
    ray.rests = vec4(-kNever);
    for (uint k = 0u; k < kKnownFields; ++k) {
        int number = tile.y > 0u ? int(fieldTexel(int(tile.x + min(k, tile.y - 1u))).x) : 0;
        for (int i = 0; i < 3; ++i)
            ray.known[3u * k + uint(i)] = fieldTexel(3 * number + i);
    }
    return ray;
}

// One of the fields of the tile. It is chosen from the known ones, as software renderers look up texels more slowly.
VoxelField fieldOfRay(FieldRay ray, uint k)
{
    vec4 texels[3];
    for (int i = 0; i < 3; ++i)
        texels[i] = k < 2u ? (k < 1u ? ray.known[i] : ray.known[3 + i]) : (k < 3u ? ray.known[6 + i] : ray.known[9 + i]);
    VoxelField field = VoxelField(texels[0], ivec4(texels[1]), texels[2]);
    if (k >= kKnownFields)
        field = fieldOf(int(fieldTexel(int(ray.tile.x + k)).x));
    return field;
}

FieldSample emptySample()
{
    FieldSample sum;
    sum.medium = vec4(0.0);
#if FX_LAYERS
    sum.shares = vec4(0.0);
    sum.scattered = vec3(0.0);
#endif
    sum.isEmpty = true;
    sum.room = sum.most = kNever;
    return sum;
}

// The first field of the tile from number `first` on that may have medium at t [m]; their count where none has.
uint nextField(FieldRay ray, uint first, float t, inout FieldSample sum)
{
    for (uint k = 0u; k < kKnownFields; ++k) {
        bool rests = k == first && k < ray.tile.y && t < ray.rests[k];
        sum.room = rests && ray.rests[k] < kNever ? min(sum.room, ray.rests[k] - t + kRounding * abs(t)) : sum.room;
        first += rests ? 1u : 0u;
    }
    return first;
}

// What a field has at a place, before its detail.
struct FieldFind
{
    bool isMedium;  // that detail may leave
    vec3 uv;        // of the textures of bricks
    vec4 medium;    // see fieldMedium
    float voxel;    // [m]
    float largest;  // [1/m] no extinction of the field is larger
    float detail;   // first texel of its detail, or 0
    float step;     // [voxel] longest step in it
    float stretched; // [1] optical depth of a step that is made longer
#if FX_DETAIL
    DetailPlace place;
    vec4 material1; // of the medium, see fieldMaterial1
    float whole;    // [1/m] extinction with which the other textures were multiplied
    vec4 near0;     // mean of the balls near the eye: coordinates of the first generation; a power of temperature
    float nearShare; // [1] of the extinction
#endif
};

// Looks at one field of a tile at t [m], which must not fall from call to call.
FieldFind lookAt(inout FieldRay ray, uint number, float t, inout FieldSample sum)
{
    VoxelField field = fieldOfRay(ray, number);
    FieldPlace place = placeInField(field, ray.origin + t * ray.direction, ray.perDirection);
    FieldFind find;
    find.isMedium = false;
    find.uv = vec3(0.0);
    find.medium = vec4(0.0);
    find.voxel = field.corner.w;
    find.largest = field.limits.y;
    find.detail = field.limits.z;
    find.step = field.limits.x < 0.0 ? kVoxelsPerVolumeStep : kVoxelsPerStep;
    find.stretched = field.limits.x < 0.0 ? kDepthPerStep : kNever;
#if FX_DETAIL
    find.place = DetailPlace(1.0, 1.0, 0.0);
    find.material1 = find.near0 = vec4(0.0);
    find.whole = find.nearShare = 0.0;
#endif
    bool isInBrick = place.number > 0;
    if (isInBrick) {
        vec3 texel = vec3(brickTexel(place.number - 1)) + 0.5 + place.local - vec3(kBrickCells * place.brick);
        find.uv = texel / vec3(textureSize(fieldMedium, 0));
        find.medium = textureLod(fieldMedium, find.uv, 0.0);
        find.isMedium = find.medium.a != 0.0;
    }
#if FX_DETAIL
    find.whole = find.medium.a;
    if (isInBrick && field.limits.z > 0.5) {
        int first = int(field.limits.z);
        vec4 soft = fieldTexel(first + kSoftTexel);
        NearMedium near;
        bool isNear = t < soft.w;
        if (isNear) {
            near = nearMedium(ray.origin + t * ray.direction, soft);
            float rest = max(find.medium.a, 0.0);
            find.nearShare = near.medium.a / max(rest + near.medium.a, 1e-20);
            find.near0 = vec4(near.carried0.xyz, near.carried1.w);
            find.medium += near.medium;
            find.whole = max(field.limits.y * textureLod(fieldScatter, find.uv, 0.0).a, find.medium.a / kMostOfWhole);
        }
        find.isMedium = find.medium.a > 0.0; // rims that are below 0 are eroded
        if (find.isMedium) {
            find.material1 = field.limits.y / find.whole * textureLod(fieldMaterial1, find.uv, 0.0);
            if (isNear)
                find.material1 = mix(find.material1, vec4(near.carried1.xyz, near.carried0.w), find.nearShare);
            find.place = detailPlace(fieldTexel(first + kErosionTexel), soft, find.medium.a, find.material1.a);
            find.isMedium = find.place.s > 0.0;
        }
    }
#endif
    float rest = isInBrick ? -kNever : place.room < kNever ? t + field.corner.w * place.room : kNever;
    ray.rests = mix(ray.rests, vec4(rest), equal(uvec4(number), uvec4(0, 1, 2, 3)));
    sum.isEmpty = sum.isEmpty && !isInBrick;
    float step = isInBrick ? field.corner.w * find.step : rest < kNever ? rest - t + kRounding * abs(t) : kNever;
    sum.room = find.isMedium ? sum.room : min(sum.room, step);
    return find;
}

// Adds what has been found at t [m] to the sum of all fields.
void addFind(FieldRay ray, FieldFind find, float t, inout FieldSample sum)
{
    vec4 medium = find.medium;
    float kept = 1.0;
    float voxels = find.step;
#if FX_DETAIL
    if (find.detail > 0.5) {
        FieldDetail numbers = fieldDetail(int(find.detail));
        vec4 material0 = vec4(0.0);
        bool isGlowing = medium.r + medium.g + medium.b > 0.0;
        if (hasLumps(find.place, isGlowing))
            material0 = textureLod(fieldMaterial0, find.uv, 0.0);
        material0 = mix(material0 * vec4(vec3(find.largest / find.whole), 1.0), find.near0, find.nearShare);
        MediumDetail detail = detailOf(numbers, find.place, ray.origin + t * ray.direction, material0.rgb, find.material1.rgb,
                                       ray.pixel.x * t + ray.pixel.y, isGlowing);
        kept = detail.share;
        voxels = detail.isLumpy ? kVoxelsPerLumpyStep : find.step;
        medium.rgb = detailedLight(medium.rgb, detail, material0.a);
    }
#endif
#if FX_DETAIL
    float held = kept * find.medium.a / (find.whole > 0.0 ? find.whole : min(find.whole, -1e-20));
#elif FX_LAYERS
    float held = kept;
#endif
#if FX_LAYERS || FX_DETAIL
    vec3 scattered = vec3(0.0);
    if (kept != 0.0)
        scattered = find.largest * textureLod(fieldScatter, find.uv, 0.0).rgb;
#endif
#if FX_LAYERS
    sum.scattered += held * scattered;
    vec4 shares = vec4(0.0);
    if (kept != 0.0)
        shares = find.largest * textureLod(fieldShares, find.uv, 0.0);
    sum.shares += held * shares;
#endif
    sum.medium += kept * medium;
#if FX_DETAIL && !FX_LAYERS
    sum.medium.rgb += held * scattered;
#endif
    float room = find.voxel * clamp(kDepthPerStep / (find.voxel * max(kept * medium.a, 1e-20)), kMinVoxelsPerStep, voxels);
    sum.room = min(sum.room, room);
    // Light of what lies deeper in dense voxels must not be seen before it.
    sum.most = min(sum.most, max(room, find.stretched / max(medium.a, 1e-20)));
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
