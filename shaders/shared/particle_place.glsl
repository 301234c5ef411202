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

// Light that a small ball of white scatters to every side, per steradian: its surface receives a quarter of what passes it.
vec3 scatteredByBall(vec3 place)
{
    const float kPerBall = 1.0 / (4.0 * 3.14159265);
    vec3 sum = 0.5 * (skyAbove.rgb + skyBelow.rgb) + sunLight.rgb * kPerBall;
    for (int i = 0; i < 4; ++i) {
        vec3 d = lightPosition[i].xyz - place;
        sum += lightIntensity[i].rgb * (kPerBall / max(dot(d, d) + lightPosition[i].w * lightPosition[i].w, 1e-20));
    }
    return sum;
}

// The same of a matt white surface.
vec3 scatteredBySurface(vec3 place, vec3 normal)
{
    const float kPerSurface = 1.0 / 3.14159265;
    vec3 sum = mix(skyBelow.rgb, skyAbove.rgb, 0.5 + 0.5 * normal.y);
    sum += sunLight.rgb * (kPerSurface * max(dot(normal, sunDirection.xyz), 0.0));
    for (int i = 0; i < 4; ++i) {
        vec3 d = lightPosition[i].xyz - place;
        float l2 = max(dot(d, d), 1e-20);
        float facing = max(dot(normal, d) * inversesqrt(l2), 0.0);
        sum += lightIntensity[i].rgb * (kPerSurface * facing / (l2 + lightPosition[i].w * lightPosition[i].w));
    }
    return sum;
}
