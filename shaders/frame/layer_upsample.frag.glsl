// A layer of reduced size at the picture's size, guided by distance.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] of each pixel, +inf for none
layout(binding = 1) uniform sampler2D farDistance;   // [m] of each texel
layout(binding = 2) uniform sampler2D farLight;
layout(binding = 3) uniform sampler2D nearDistance;  // [m], 0 where the texel saw one surface only
layout(binding = 4) uniform sampler2D nearLight;
layout(std140, binding = 0) uniform UpsampleBlock
{
    vec4 upsample; // x: pixels along a block's side; y: reach in relative 1 / distance; z: 1 when there is a near picture
};
layout(location = 0) out vec4 light;

// 1 / distance: 0 for nothing, finite for what touches the eye.
float closeness(float d)
{
    return d < 1e30 ? 1.0 / max(d, 1e-30) : 0.0;
}

// The media of texel q in front of a surface of that closeness, and the difference in closeness [1].
vec4 lightAt(ivec2 q, float asked, out float mismatch)
{
    vec4 value = texelFetch(farLight, q, 0);
    float low = closeness(texelFetch(farDistance, q, 0).r);
    float known = low;
    float nearest = upsample.z > 0.5 ? texelFetch(nearDistance, q, 0).r : 0.0;
    if (nearest > 0.0) {
        float high = closeness(nearest);
        known = clamp(asked, low, high);
        value += (known - low) / (high - low) * (texelFetch(nearLight, q, 0) - value);
    }
    mismatch = abs(asked - known) / max(max(asked, known), 1e-30);
    return value;
}

// 1 for the same surface, 0 beyond reach.
float agreement(float mismatch)
{
    float a = max(1.0 - mismatch * mismatch / (upsample.y * upsample.y), 0.0);
    return a * a;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(farLight, 0) - 1;
    int size = int(upsample.x);
    ivec2 own = pixel / size;
    vec2 middle = (vec2(pixel) + 0.5) / upsample.x - 0.5;
    vec2 f = middle - floor(middle);
    ivec2 low = ivec2(floor(middle));
    float asked = closeness(texelFetch(sceneDistance, pixel, 0).r);

    float mismatch;
    vec4 ownLight = lightAt(own, asked, mismatch); // the block holds this pixel, so it never fails
    vec4 difference = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 q = low + corner;
        vec2 bilinear = mix(1.0 - f, f, vec2(corner));
        float weight = bilinear.x * bilinear.y;
        if (q != own) {
            vec4 other = lightAt(clamp(q, ivec2(0), last), asked, mismatch);
            weight *= agreement(mismatch);
            difference += weight * (other - ownLight); // equal texels add exactly nothing
        }
        weights += weight;
    }
    light = ownLight + difference / weights; // own weight is at least 1/4
}
