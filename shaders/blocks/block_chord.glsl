// The optical depth of a block along a ray, from its tile: see blocks/block_tiles.comp.glsl. Needs slabs/slab_balls.glsl.
layout(binding = 12) uniform sampler2D blockAtlas;

// What a tile knows of a ray.
struct BlockChord
{
    vec4 before, behind; // [1] depth between planes 0 to 4, and 4 to 8, over that of the whole chord
    vec4 color;          // rgb albedo; w 1: of the tile, 0: of the ball
    vec3 light;          // [exposed] emitted light of the tile
    float start;         // [m] ray parameter of plane 0
    float perPlane;      // [1/m] planes a metre of the ray
    float depth;         // [1] of the whole chord, at density 1
};

vec4 tileAt(vec2 texel, float layer)
{
    vec2 size = vec2(textureSize(blockAtlas, 0));
    return textureLod(blockAtlas, vec2(texel.x, texel.y + 0.25 * layer * size.y) / size, 0.0);
}

// Where a point relative to the center of the block is in its tile [1], -1..1, as seen by the eye of the tile.
// perHalf: [1/m] one over half the side of the tile; nearness: [1] of the depth of the point, over that of the eye of the tile
vec2 placeInTile(vec3 p, vec3 right, vec3 up, float perHalf, float nearness)
{
    return clamp(vec2(dot(p, right), dot(p, up)) * perHalf / max(1.0 + nearness, 0.1), -1.0, 1.0);
}

vec2 texelAt(vec2 place, vec4 tile) { return tile.yz + 0.5 + (0.5 + 0.5 * place) * (tile.x - 1.0); }

BlockChord emptyBlockChord()
{
    return BlockChord(vec4(0.0), vec4(0.0), vec4(0.0), vec3(0.0), 0.0, 0.0, 0.0);
}

// @param toCenter [m] from the origin of the ray to the center of the block
BlockChord blockChord(uint ball, vec3 toCenter, vec3 direction, float radius)
{
    vec4 right = texelFetch(balls, ballTexel(ball, kTileRight), 0);
    vec4 up = texelFetch(balls, ballTexel(ball, kTileUp), 0);
    vec4 tile = texelFetch(balls, ballTexel(ball, kTile), 0);
    vec3 along = cross(up.xyz, right.xyz);
    float nearness = fract(up.w); // [1] radius of the block over the distance of the eye of the tile
    float center = floor(up.w) / 127.0 - 1.0; // [radius] from the plane through the center, of the middle of the medium
    float flat_ = sqrt(1.0 - nearness * nearness);
    float perHalf = flat_ / radius; // [1/m]
    float perLength = max(dot(direction, along), 0.1);
    float middle = dot(toCenter, along) / perLength; // [m] ray parameter of the plane through the center
    // The ray may differ from that of the tile: it is looked up where the middle of the medium is on it. That of all of the block is
    // the first guess.
    vec2 at = placeInTile((middle + center * radius / perLength) * direction - toCenter, right.xyz, up.xyz, perHalf, center * nearness);
    vec2 texel = texelAt(at, tile);
    vec4 near = tileAt(texel, 0.0), far = tileAt(texel, 1.0);
    float whole = max(far.w, 1e-12);
    float ofRay = 1.0 - (near.x + near.y + near.z + near.w + far.x + far.y + far.z + 0.5 * far.w) * 0.25 / whole;
    center = far.w > 0.0 ? clamp(ofRay, -1.0, 1.0) : center;
    at = placeInTile((middle + center * radius / perLength) * direction - toCenter, right.xyz, up.xyz, perHalf, center * nearness);
    texel = texelAt(at, tile);
    near = tileAt(texel, 0.0);
    far = tileAt(texel, 1.0);
    float ofTile = inversesqrt(1.0 + dot(at, at) * nearness * nearness / (flat_ * flat_)); // perLength of its ray
    BlockChord chord;
    float perDepth = 1.0 / max(far.w, 1e-12);
    chord.before = perDepth * (near - vec4(0.0, near.xyz));
    chord.behind = perDepth * (far - vec4(near.w, far.xyz));
    chord.depth = max(far.w, 0.0) * ofTile / perLength;
    chord.start = middle - radius / perLength;
    chord.perPlane = 4.0 * perLength / radius;
    chord.color = vec4(0.0);
    chord.light = vec3(0.0);
    for (int i = 0; i < (tile.w >= 0.0 ? 1 : 0); ++i) { // software renderers skip a loop without turns
        chord.color = vec4(perDepth * tileAt(texel, 2.0).rgb, 1.0);
        chord.light = tile.w * perDepth * tileAt(texel, 3.0).rgb;
    }
    return chord;
}

// x share of the depth up to a ray parameter; y its first moment: the integral of the distance from the middle of the block, in
// units of half its extent along the ray.
vec2 blockPassed(BlockChord chord, float t)
{
    const vec4 kFirst = vec4(0.0, 1.0, 2.0, 3.0);
    float place = (t - chord.start) * chord.perPlane;
    vec4 near = clamp(place - kFirst, 0.0, 1.0), far = clamp(place - 4.0 - kFirst, 0.0, 1.0);
    vec4 nearPart = chord.before * near, farPart = chord.behind * far;
    float share = dot(nearPart, vec4(1.0)) + dot(farPart, vec4(1.0));
    float moment = dot(nearPart, kFirst + 0.5 * near) + dot(farPart, kFirst + 4.0 + 0.5 * far);
    return vec2(share, 0.25 * moment - share);
}
