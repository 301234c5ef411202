// Where a particle is: drag-coefficients and ballistic-motion, as simulation/particles/motion_lanes-inl.h has them.

struct Drag
{
    float decay; // [1]
    float gain;  // [s]
    float ramp;  // [s2]
};

Drag dragOf(float t)
{
#if FX_DRAGS
    precise float k = drag;
    precise float z = k * t;
    precise float z2 = z * z;
    precise float z4 = z2 * z2;
    precise float p0 = 0.5 - 0.166666597 * z;
    precise float p1 = 0.0416659452 - 0.00833040196 * z;
    precise float p2 = 0.00138298643 - 0.000191851024 * z;
    precise float p3 = 2.06316363e-05 - 1.26966074e-06 * z;
    precise float q = (p0 + z2 * p1) + z4 * (p2 + z2 * p3);
    precise float ramp = q * (t * t);
    precise float gain = t - k * ramp;
    precise float decay = 1.0 - k * gain;
    if (z < 1.0)
        return Drag(decay, gain, ramp);
    precise float e = expMinus(z);
    if (z < 2.0)
        return Drag(e, gain, ramp);
    precise float g = (1.0 - e) * perDrag;
    precise float r = (t - g) * perDrag;
    return Drag(e, g, r);
#else
    precise float way = 0.5 * t * t;
    return Drag(1.0, t, way);
#endif
}

// Moves a particle from its birth to now, through all that has acted on it since.
void fly(uvec2 age, inout vec3 x, inout vec3 v)
{
    int count = conditionCount();
    for (int i = 0; i < count; ++i) {
        uvec2 ended = i + 1 < count ? pairAt(conditionAt(i + 1)) : uvec2(0u);
        uvec2 flown = sub64(age, ended);
        if (!isPositive(flown))
            continue; // over before it was born
        int at = conditionAt(i);
        float t = min(secondsOf(flown), secondsOf(sub64(pairAt(at), ended)));
        vec3 pull = vec3(uintBitsToFloat(words[at + 2]), uintBitsToFloat(words[at + 3]), uintBitsToFloat(words[at + 4]));
        Drag step = dragOf(t);
        precise vec3 there = (x + step.gain * v) + step.ramp * pull;
        precise vec3 then = step.decay * v + step.gain * pull;
        x = there;
        v = then;
    }
}
