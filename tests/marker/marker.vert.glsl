// One square a marker. Needs shared/view_block.glsl.
struct Marker
{
    vec4 centerHalf; // [m] relative to the eye; half of the side
    vec4 light;      // exposed
};
layout(std430, binding = 0) readonly buffer Markers
{
    Marker markers[];
};

flat out vec3 markerLight;
out vec3 markerPlace;

void main()
{
    Marker marker = markers[gl_InstanceID + int(pass.y)];
    const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec2 corner = corners[gl_VertexID] * marker.centerHalf.w;
    markerPlace = marker.centerHalf.xyz + corner.x * right.xyz + corner.y * up.xyz;
    markerLight = marker.light.rgb;
    float depth = dot(markerPlace, forward.xyz);
    vec2 across = vec2(dot(markerPlace, right.xyz) * right.w, dot(markerPlace, up.xyz) * up.w);
    gl_Position = vec4(across + clipOffset.xy * depth, 0.0, depth);
}
