// Depth from the sun as a color, so that it can be sampled like any texture.
layout(location = 0) out vec4 depth;

void main()
{
    depth = vec4(gl_FragCoord.z);
}
