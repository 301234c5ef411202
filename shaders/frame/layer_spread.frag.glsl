// Lets each texel of a smaller layer that saw one surface know the other surface beside it, so that texels on both sides
// of an edge can be mixed for either side and the block grid does not show.
layout(binding = 0) uniform sampler2D blockFar;  // [m] largest distance of each block, +inf for none
layout(binding = 1) uniform sampler2D blockNear; // [m] smallest, 0 where the block is flat
layout(std140, binding = 0) uniform SpreadBlock
{
    vec4 spread; // x: relative difference of distance from which a surface is another one
};
layout(location = 0) out float farDistance;
layout(location = 1) out float nearDistance;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(blockFar, 0) - 1;
    farDistance = texelFetch(blockFar, texel, 0).r;
    nearDistance = texelFetch(blockNear, texel, 0).r;
    if (nearDistance > 0.0)
        return; // an edge runs through it
    float own = farDistance;
    float low = own;
    float high = own;
    for (int i = 0; i < 9; ++i) {
        ivec2 q = clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        float f = texelFetch(blockFar, q, 0).r;
        float n = texelFetch(blockNear, q, 0).r;
        high = max(high, f);
        low = min(low, n > 0.0 ? n : f);
    }
    if (low < (1.0 - spread.x) * own) {
        nearDistance = low;
    } else if (own < (1.0 - spread.x) * high) {
        nearDistance = own;
        farDistance = high;
    }
}
