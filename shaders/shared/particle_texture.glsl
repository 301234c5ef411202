// Frames of a particle's texture. Needs shared/particle_block.glsl and shared/view_block.glsl.
layout(binding = 1) uniform sampler2DArray frames;       // color and opacity, one layer a frame
layout(binding = 2) uniform sampler2DArray frameMotion;  // red, green: way to the next frame, 0.5 none

vec2 motionAt(vec2 uv, float frame)
{
    vec2 way = texture(frameMotion, vec3(uv, frame)).rg * (255.0 / 127.5) - (128.0 / 127.5); // 128 is none
    return vec2(way.x, -way.y) * atlas.z; // files count downwards
}

// Color and opacity at `uv` of the frame number `frame`; the last frame is followed by the first.
vec4 frameTexel(vec2 uv, float frame)
{
    float first = floor(frame);
    float part = atlas.y > 0.5 ? frame - first : 0.0;
    first = mod(first, atlas.x);
    if (part == 0.0)
        return texture(frames, vec3(uv, first));
    float second = mod(first + 1.0, atlas.x);
    vec2 fromFirst = uv;
    vec2 fromSecond = uv;
    if (strip.x > 0.5) {
        fromFirst -= part * motionAt(uv, first);
        fromSecond += (1.0 - part) * motionAt(uv, second);
    }
    vec4 a = texture(frames, vec3(fromFirst, first));
    vec4 b = texture(frames, vec3(fromSecond, second));
    float alpha = mix(a.a, b.a, part);
    return vec4(mix(a.a * a.rgb, b.a * b.rgb, part) / max(alpha, 1e-6), alpha);
}
