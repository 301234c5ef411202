// Where a corner of a particle lands on the picture. Needs shared/view_block.glsl and shared/particle_block.glsl.

// Clip position of a point relative to the eye; clipped at or before the near plane in either clip convention, the rest
// of what is too near is left to the fragments.
vec4 clipOf(vec3 place)
{
    vec3 c = vec3(dot(place, right.xyz), dot(place, up.xyz), dot(place, forward.xyz));
    vec2 scale = vec2(right.w, up.w);
    if (rayOrigin.w > 0.5)
        return vec4(c.xy * scale + clipOffset.xy, 0.5, 1.0);
    return vec4(c.xy * scale + clipOffset.xy * c.z, max(c.z - rayOriginX.w, -c.z), c.z);
}

vec4 clippedAway() { return vec4(2.0, 2.0, 2.0, 1.0); }

// Unit vector from the eye towards a point.
vec3 lookAt(vec3 place)
{
    return rayOrigin.w > 0.5 ? forward.xyz : place / max(length(place), 1e-20);
}

// Metres that a pixel covers at a point.
float pixelSize(vec3 place)
{
    return (rayOrigin.w > 0.5 ? 1.0 : max(dot(place, forward.xyz), 1e-20)) / abs(sunDirection.w);
}
