// The shadow of media on the surfaces of a game: fxMediaTransmittance() is the share of a light that media let through.
// GLSL 4.20 or later. Numbers and texture come from fxView_GetMediaShadow(), docs/howto/light-slices.md shows how.

// As the members of FxMediaShadow in the C API, from `right` on; layout std140. Levels are stacks of planes of the same
// light, the first is the widest and coarsest.
struct FxMediaShadow
{
    vec4 right[3]; // parallel light: texel x = dot(right.xyz, p) + right.w
    vec4 up[3];    // texel y likewise
    vec4 along[3]; // plane likewise; of a point: w times the distance - x
    vec4 tiles[3]; // xy texel of the first plane in the texture; z texels along a side; w planes, 0: there is no such level
    vec4 place;    // of a point: xyz [m] relative to the frame's origin; w 0 parallel light, 1 a point
};

// x optical depth up to a plane; y between it and the next. The planes of a level lie in rows of eight tiles.
vec2 fxMediaPlane(sampler2D planes, vec4 tiles, int plane, vec2 texel)
{
    vec2 tile = tiles.xy + tiles.z * vec2(plane % 8, plane / 8);
    return textureLod(planes, (tile + texel) / vec2(textureSize(planes, 0)), 0.0).rg;
}

// Optical depth up to a place: texel x, texel y, plane. Linear between texels and between planes.
float fxMediaDepth(sampler2D planes, vec4 tiles, vec3 place)
{
    vec2 texel = clamp(place.xy, vec2(0.5), vec2(tiles.z - 0.5));
    float plane = clamp(place.z, 0.0, tiles.w - 1.0);
    int lower = min(int(plane), int(tiles.w) - 2);
    vec2 depth = fxMediaPlane(planes, tiles, lower, texel);
    return depth.x + (plane - float(lower)) * depth.y;
}

// Share of the light that reaches p through media, per color. planes: filters linearly. p [m]: relative to the frame's origin.
vec3 fxMediaTransmittance(sampler2D planes, FxMediaShadow shadow, vec3 p)
{
    vec4 tiles = shadow.tiles[0];
    if (tiles.w < 0.5)
        return vec3(1.0);
    vec3 place = vec3(dot(shadow.right[0].xyz, p) + shadow.right[0].w, dot(shadow.up[0].xyz, p) + shadow.up[0].w,
                      dot(shadow.along[0].xyz, p) + shadow.along[0].w);
    if (shadow.place.w > 0.5) {
        vec3 d = p - shadow.place.xyz;
        vec3 unit = d / max(abs(d.x) + abs(d.y) + abs(d.z), 1e-12);
        vec2 folded = (1.0 - abs(unit.yx)) * vec2(unit.x >= 0.0 ? 1.0 : -1.0, unit.y >= 0.0 ? 1.0 : -1.0);
        vec2 direction = unit.z < 0.0 ? folded : unit.xy; // octahedral map
        place = vec3(1.0 + (0.5 + 0.5 * direction) * (tiles.z - 2.0), length(d) * shadow.along[0].w - shadow.along[0].x);
    }
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
