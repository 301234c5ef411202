// Opaque before the scene, nothing behind it. Needs shared/view_block.glsl.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none

flat in vec3 markerLight;
in vec3 markerPlace;
layout(location = 0) out vec4 light;

void main()
{
    if (length(markerPlace) > texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r)
        discard;
    light = vec4(markerLight, 1.0);
}
