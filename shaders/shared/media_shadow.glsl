// The shadow of media on the surfaces of a game: fxMediaTransmittance() is the share of a light that media let through.
// GLSL 4.20 or later. Numbers and texture come from fxView_GetMediaShadow(), docs/howto/light-slices.md shows how.

// As the members of FxMediaShadow in the C API, from `right` on; layout std140. Levels are stacks of planes of the same
// light, the first is the widest and coarsest.
struct FxMediaShadow
{
    vec4 right[3]; // parallel light: texel x = dot(right.xyz, p) + right.w; of a point: rows of the matrix to meters and the
                   // axes of the planes
    vec4 up[3];    // texel y likewise
    vec4 along[3]; // plane likewise; of a point: w times the distance [m] - x; y radius of the glowing ball that it stands for [m]
    vec4 tiles[3]; // xy texel of the first plane in the texture; z texels along a side; w planes, 0: there is no such level
    vec4 place;    // of a point: xyz relative to the frame's origin, in units and axes of the host; w 0 parallel light, 1 a point
};

// x optical depth up to a plane; y between it and the next. The planes of a level lie in rows of eight tiles.
vec2 fxMediaPlane(sampler2D planes, vec4 tiles, int plane, vec2 texel)
{
    vec2 tile = tiles.xy + tiles.z * vec2(plane % 8, plane / 8);
    return textureLod(planes, (tile + texel) / vec2(textureSize(planes, 0)), 0.0).rg;
}

// Optical depth within a slab between two planes up to `share` of its length, from those of the slabs before, between and
// behind: a cubic whose slope at a plane is the harmonic mean of the slabs on both sides.
float fxMediaSlab(float before, float between, float behind, float share)
{
    float first = 2.0 * before * between / max(before + between, 1e-30);
    float last = 2.0 * between * behind / max(between + behind, 1e-30);
    float rest = 1.0 - share;
    return share * rest * rest * first + share * share * ((3.0 - 2.0 * share) * between - rest * last);
}

// Optical depth up to a place: texel x, texel y, plane. Linear between texels.
float fxMediaDepth(sampler2D planes, vec4 tiles, vec3 place)
{
    vec2 texel = clamp(place.xy, vec2(0.5), vec2(tiles.z - 0.5));
    float plane = clamp(place.z, 0.0, tiles.w - 1.0);
    int lower = min(int(plane), int(tiles.w) - 2);
    vec2 slab = fxMediaPlane(planes, tiles, lower, texel);
    float before = lower > 0 ? fxMediaPlane(planes, tiles, max(lower - 1, 0), texel).y : slab.y;
    float behind = fxMediaPlane(planes, tiles, lower + 1, texel).y;
    return slab.x + fxMediaSlab(before, slab.y, behind, plane - float(lower));
}

// Where a direction from a light at a point lies among `texels` of a plane along a side: an octahedral map.
vec2 fxMediaTexel(vec3 d, float texels)
{
    vec3 unit = d / max(abs(d.x) + abs(d.y) + abs(d.z), 1e-12);
    vec2 folded = (1.0 - abs(unit.yx)) * vec2(unit.x >= 0.0 ? 1.0 : -1.0, unit.y >= 0.0 ? 1.0 : -1.0);
    return 1.0 + (0.5 + 0.5 * (unit.z < 0.0 ? folded : unit.xy)) * (texels - 2.0);
}

// Mean transmittance from a glowing ball to p: of 16 places of it, seen through what stands next to it.
float fxMediaPenumbra(sampler2D planes, FxMediaShadow shadow, vec3 p)
{
    vec3 fromLight = p - shadow.place.xyz;
    vec3 d = vec3(dot(shadow.right[0].xyz, fromLight), dot(shadow.right[1].xyz, fromLight), dot(shadow.right[2].xyz, fromLight));
    float away = length(d);
    float nearest = shadow.along[0].x / max(shadow.along[0].w, 1e-12); // [m] the first shell
    float caster = max(min(max(1.2 * shadow.along[0].y, nearest), away / 1.3), 1e-12);
    float reach = max(shadow.along[0].y * (1.0 / caster - 1.0 / max(away, 1e-12)), 0.0); // of directions from the middle
    vec3 towards = d / max(away, 1e-12);
    vec3 right = normalize(cross(towards, abs(towards.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 up = cross(right, towards);
    float plane = away * shadow.along[0].w - shadow.along[0].x;
    int places = reach > 0.0 ? 16 : 1;
    float sum = 0.0;
    for (int i = 0; i < places; ++i) {
        float r = places > 1 ? reach * sqrt((float(i) + 0.5) / 16.0) : 0.0;
        float turn = 2.39996323 * float(i); // the golden angle
        vec2 texel = fxMediaTexel(towards + r * (cos(turn) * right + sin(turn) * up), shadow.tiles[0].z);
        sum += exp(-fxMediaDepth(planes, shadow.tiles[0], vec3(texel, plane)));
    }
    return sum / float(places);
}

// Share of the light that reaches p through media, per color. planes: filters linearly. p: relative to the frame's
// origin, in units and axes of the host, meters unless FxContextDef states others.
vec3 fxMediaTransmittance(sampler2D planes, FxMediaShadow shadow, vec3 p)
{
    vec4 tiles = shadow.tiles[0];
    if (tiles.w < 0.5)
        return vec3(1.0);
    vec3 place = vec3(dot(shadow.right[0].xyz, p) + shadow.right[0].w, dot(shadow.up[0].xyz, p) + shadow.up[0].w,
                      dot(shadow.along[0].xyz, p) + shadow.along[0].w);
    if (shadow.place.w > 0.5)
        return vec3(fxMediaPenumbra(planes, shadow, p));
    for (int i = 1; i < 3 && shadow.tiles[i].w > 0.5; ++i) {
        vec3 finer = vec3(dot(shadow.right[i].xyz, p) + shadow.right[i].w, dot(shadow.up[i].xyz, p) + shadow.up[i].w,
                          dot(shadow.along[i].xyz, p) + shadow.along[i].w);
        vec4 size = shadow.tiles[i];
        if (all(greaterThan(finer, vec3(1.0, 1.0, 0.0))) && all(lessThan(finer, size.zzw - 1.0))) {
            tiles = size; // only inside of its planes does a finer level know the depth
            place = finer;
        }
    }
    return vec3(exp(-fxMediaDepth(planes, tiles, place)));
}
