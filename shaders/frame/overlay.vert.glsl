// Edges of boxes as lines of a constant width, each of them two triangles.
layout(std140, binding = 0) uniform OverlayBlock
{
    mat4 toClip; // of positions relative to the camera's origin
    vec4 line;   // x, y: half a line's width in clip space
};

struct Box
{
    vec4 centerHalf; // center [m], half of the side [m]
    vec4 color;      // premultiplied
};
layout(std430, binding = 0) readonly buffer Boxes
{
    Box boxes[];
};

flat out vec4 lineColor;

void main()
{
    Box box = boxes[gl_InstanceID];
    lineColor = box.color;
    int edge = gl_VertexID / 6;
    int axis = edge / 4;
    vec3 a;
    a[axis] = -1.0;
    a[(axis + 1) % 3] = (edge & 1) != 0 ? 1.0 : -1.0;
    a[(axis + 2) % 3] = (edge & 2) != 0 ? 1.0 : -1.0;
    vec3 b = a;
    b[axis] = 1.0;
    vec4 p = toClip * vec4(box.centerHalf.xyz + box.centerHalf.w * a, 1.0);
    vec4 q = toClip * vec4(box.centerHalf.xyz + box.centerHalf.w * b, 1.0);
    const float nearest = 1e-3; // what is behind the eye has no place on the picture
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    if (p.w < nearest && q.w < nearest)
        return;
    if (p.w < nearest)
        p = mix(p, q, (nearest - p.w) / (q.w - p.w));
    else if (q.w < nearest)
        q = mix(q, p, (nearest - q.w) / (p.w - q.w));
    vec2 begin = p.xy / p.w;
    vec2 end = q.xy / q.w;
    vec2 along = (end - begin) / line.xy;
    float way = length(along);
    vec2 across = way > 0.0 ? vec2(-along.y, along.x) / way : vec2(0.0);
    int corner = gl_VertexID % 6; // begin-, begin+, end-; end-, begin+, end+
    bool isEnd = corner == 2 || corner == 3 || corner == 5;
    float side = (corner == 1 || corner == 4 || corner == 5) ? 1.0 : -1.0;
    gl_Position = vec4((isEnd ? end : begin) + side * across * line.xy, 0.0, 1.0);
}
