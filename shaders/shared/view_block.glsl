// The view of one frame; filled from rendering/frame/view_block.h, which asserts this layout.
layout(std140, binding = 0) uniform ViewBlock
{
    vec4 rayOrigin;      // [m] relative to the eye, of the ray through the window's center; w: 1 orthographic, 0 perspective
    vec4 rayOriginX;     // change of it for one unit of window x in [-1, 1]; w: near distance along the axis [m]
    vec4 rayOriginY;     // w: flip of window y against clip y, 1 or -1
    vec4 rayDirection;   // direction through the center, its component along the view axis is 1; w 1: no other range of depth is drawn
    vec4 rayDirectionX;  // w: width [pixel]
    vec4 rayDirectionY;  // w: height [pixel]
    vec4 right;          // [1] camera axes in world; w: clip x per unit of slope
    vec4 up;             // w: clip y per unit of slope
    vec4 forward;        // w: strength of blob detail [1]
    vec4 clipOffset;     // xy: clip position of the view axis; zw: depths along the axis between which media are drawn [m]
    vec4 depthScale;     // distance along the axis = (x - n y) / (n z - w) for clip depth n
    vec4 depthRange;     // clip depth n = x d + y for a stored depth d; z: stored depth that means nothing is there
    vec4 sunDirection;   // [1] towards the sun; w: pixels per unit of slope vertically
    vec4 pass;           // a pass's own four numbers
#ifdef FX_VIEW_EXTRA
    FX_VIEW_EXTRA        // members of shared/particle_block.glsl
#endif
};

// Ray through the window position gl_FragCoord.xy. Its parameter is the distance along the ray [m].
void viewRay(vec2 window, out vec3 origin, out vec3 direction, out float lengthPerDepth)
{
    vec2 ndc = window / vec2(rayDirectionX.w, rayDirectionY.w) * 2.0 - 1.0;
    origin = rayOrigin.xyz + ndc.x * rayOriginX.xyz + ndc.y * rayOriginY.xyz;
    vec3 d = rayDirection.xyz + ndc.x * rayDirectionX.xyz + ndc.y * rayDirectionY.xyz;
    lengthPerDepth = length(d);
    direction = d / lengthPerDepth;
}

// Where the part of a ray that is drawn begins and ends [m]. open: where it is visible, of all depths
vec2 drawnPart(vec2 open, float lengthPerDepth)
{
    return vec2(max(open.x, clipOffset.z * lengthPerDepth), min(open.y, clipOffset.w * lengthPerDepth));
}

// Share of something thin at a distance along the ray that lies between the depths that are drawn. It counts as spread evenly
// over `reach` to both sides [m], so that the shares of adjacent ranges are 1 in all.
float shareInRange(float distanceAlong, float reach, float lengthPerDepth)
{
    vec2 room = clipOffset.zw * lengthPerDepth - distanceAlong;
    if (!(reach > 0.0))
        return room.x <= 0.0 && room.y > 0.0 ? 1.0 : 0.0;
    vec2 passed = clamp(0.5 + 0.5 * room / reach, 0.0, 1.0);
    return passed.y - passed.x;
}
