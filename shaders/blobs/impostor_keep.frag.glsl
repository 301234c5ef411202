// A texel of a picture that was just taken, to where it is kept.
layout(binding = 0) uniform sampler2D taken; // premultiplied
flat in ivec2 fromTexel;
layout(location = 0) out vec4 kept;

void main()
{
    kept = texelFetch(taken, ivec2(gl_FragCoord.xy) + fromTexel, 0);
}
