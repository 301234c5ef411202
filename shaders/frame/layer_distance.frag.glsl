// The range of the scene's distance within the block of pixels that one texel of a smaller layer covers.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray, +inf for none
layout(std140, binding = 0) uniform BlockSize
{
    vec4 block; // x: pixels along a side; y: relative span of 1 / distance up to which the block is flat
};
layout(location = 0) out float farDistance;
layout(location = 1) out float nearDistance;

void main()
{
    int size = int(block.x);
    ivec2 first = ivec2(gl_FragCoord.xy) * size;
    ivec2 last = textureSize(sceneDistance, 0) - 1;
    float low = uintBitsToFloat(0x7F800000u);
    float high = 0.0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            float d = texelFetch(sceneDistance, min(first + ivec2(x, y), last), 0).r;
            low = min(low, d);
            high = max(high, d);
        }
    bool flatBlock = low == high || low >= (1.0 - block.y) * high; // 1 / low - 1 / high <= span / low, infinite or not
    farDistance = flatBlock && low < high ? 0.5 * (low + high) : high;
    nearDistance = flatBlock ? 0.0 : low;
}
