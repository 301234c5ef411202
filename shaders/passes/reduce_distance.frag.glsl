// Distances of the opaque picture at a half or a quarter of its size: in turn the nearest and the farthest of what a
// texel covers, so that both sides of an edge have neighbors to be rebuilt from.
layout(binding = 0) uniform sampler2D sceneDistance;
layout(std140, binding = 0) uniform ReduceBlock { ivec4 size; }; // x, y of the full picture; z how many times smaller
layout(location = 0) out float reduced;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    bool takesNear = ((p.x + p.y) & 1) == 0;
    float value = takesNear ? uintBitsToFloat(0x7F800000u) : -1.0;
    for (int y = 0; y < size.z; ++y)
        for (int x = 0; x < size.z; ++x) {
            float d = texelFetch(sceneDistance, min(p * size.z + ivec2(x, y), size.xy - 1), 0).r;
            value = takesNear ? min(value, d) : max(value, d);
        }
    reduced = value;
}
