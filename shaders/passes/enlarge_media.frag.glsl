// Media drawn small to full size: bilinear among the four texels around, but only from those as far away as this pixel.
layout(binding = 0) uniform sampler2D smallMedia;    // premultiplied
layout(binding = 1) uniform sampler2D smallDistance; // [m]
layout(binding = 2) uniform sampler2D sceneDistance; // [m]
layout(std140, binding = 0) uniform EnlargeBlock { vec4 scale; }; // x how many times smaller; y relative distance that parts
layout(location = 0) out vec4 media;

// How unlike two distances are: 0 alike, 1 parted.
float unlike(float a, float b)
{
    if (isinf(a) || isinf(b))
        return isinf(a) && isinf(b) ? 0.0 : 1e3;
    return abs(a - b) / (scale.y * max(min(a, b), 1e-3));
}

void main()
{
    ivec2 last = textureSize(smallMedia, 0) - 1;
    float here = texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r;
    vec2 at = gl_FragCoord.xy / scale.x - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 part = at - vec2(corner);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 p = clamp(corner + offset, ivec2(0), last);
        vec2 w = mix(1.0 - part, part, vec2(offset));
        float weight = (w.x * w.y + 1e-4) / (1e-4 + pow(1.0 + unlike(here, texelFetch(smallDistance, p, 0).r), 4.0));
        sum += weight * texelFetch(smallMedia, p, 0);
        weights += weight;
    }
    media = sum / weights;
}
