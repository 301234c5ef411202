// Covering rectangle of a ball in clip space: tight tangent planes per axis, the full window when the eye is inside.
// The near plane does not matter: the rectangle bounds rays, and the ray's start cuts the ball per fragment.
// Needs shared/view_block.glsl.

// Slopes at which the planes through the eye touch the ball, in the plane of one screen axis and the view axis.
vec2 tangentSlopes(float c, float depth, float radius)
{
    float l2 = c * c + depth * depth - radius * radius;
    if (l2 <= 0.0)
        return vec2(-1e9, 1e9); // seen along the other axis, the eye is inside
    float l = sqrt(l2);
    vec2 low = vec2(c * l - depth * radius, depth * l + c * radius);
    vec2 high = vec2(c * l + depth * radius, depth * l - c * radius);
    return vec2(low.y > 0.0 ? low.x / low.y : -1e9, high.y > 0.0 ? high.x / high.y : 1e9);
}

// Clip position of corner `vertex` (0..5, two triangles).
vec4 blobQuadCorner(vec3 center, float radius, int vertex)
{
    vec2 corner = vec2(vertex == 1 || vertex == 2 || vertex == 4 ? 1.0 : 0.0,
                       vertex == 2 || vertex == 4 || vertex == 5 ? 1.0 : 0.0);
    vec3 c = vec3(dot(center, right.xyz), dot(center, up.xyz), dot(center, forward.xyz));
    vec2 low;
    vec2 high;
    vec2 scale = vec2(right.w, up.w);
    if (rayOrigin.w > 0.5) {
        low = (c.xy - radius) * scale + clipOffset.xy;
        high = (c.xy + radius) * scale + clipOffset.xy;
    } else {
        vec2 x = tangentSlopes(c.x, c.z, radius);
        vec2 y = tangentSlopes(c.y, c.z, radius);
        low = vec2(x.x, y.x) * scale + clipOffset.xy;
        high = vec2(x.y, y.y) * scale + clipOffset.xy;
    }
    low = clamp(low, vec2(-1.0), vec2(1.0));
    high = clamp(high, vec2(-1.0), vec2(1.0));
    return vec4(mix(low, high, corner), 0.5, 1.0); // depth 0.5 is inside both clip ranges; the depth test is off
}
