// Particles whose motion has no closed form: from where they have come to, or from their births, through steps. What has been reached
// is kept for the next frame. FX_STEP_WORDS: words of a step; FX_FORCES and FX_CONTACTS call the modules of the emitter.
layout(std430, binding = 3) buffer ReachedRows { uint reached[]; }; // 7 columns: place, velocity, flags
layout(std430, binding = 4) readonly buffer Steps { uint stepWords[]; }; // since when rows are reached (ticks ago), 1: they are; steps

#include "gpu_particles/gpu_particle_forces.glsl"
#include "gpu_particles/gpu_particle_contacts.glsl"

const int kStepsAt = 4;

// [s] as the steps of the CPU have it, whatever FX_BRIEF
float secondsOfStep(uvec2 ticks)
{
    precise double wide = double(ticks.y) * 4294967296.0lf + double(ticks.x);
    precise double seconds = wide * 1.4172335600907028e-09lf;
    return float(seconds);
}

void takeStep(uint number, uvec2 age, float perLife)
{
    stepAt = kStepsAt + int(number) * FX_STEP_WORDS;
    uvec2 left = sub64(age, uvec2(stepWords[stepAt], stepWords[stepAt + 1]));
    if (!isPositive(left) || isStuck || isKilled)
        return; // not born yet, or at rest
    uvec2 before = sub64(left, uvec2(stepWords[stepAt + 2], 0u));
    float seconds = isPositive(before) ? secondsOfStep(before) : 0.0;
    precise float life = seconds * perLife;
    if (!(life < 1.0))
        return;
    atLife = life;
    atSeconds = min(secondsOfStep(left), stepFloat(3));
    stepPull = vec3(0.0);
    stepAir = vec3(0.0);
    stepQuadratic = 0.0;
    FX_FORCES
    fromX = atX;
    fromV = atV;
    integrate();
    FX_CONTACTS
}

uint reachedAt(uint column, uint row) { return column * rowCount() + row; }
vec3 reachedVector(uint column, uint row)
{
    return uintBitsToFloat(uvec3(reached[reachedAt(column, row)], reached[reachedAt(column + 1u, row)], reached[reachedAt(column + 2u, row)]));
}
void keepVector(uint column, uint row, vec3 v)
{
    for (int a = 0; a < 3; ++a)
        reached[reachedAt(column + uint(a), row)] = floatBitsToUint(v[a]);
}

// True when the row of a particle of this age has been computed before.
bool isReached(uvec2 age, uint firstStep)
{
    int at = firstStep > 0u ? kStepsAt + int(firstStep - 1u) * FX_STEP_WORDS : 0;
    bool isThere = firstStep > 0u || stepWords[2] != 0u;
    return isThere && isPositive(sub64(age, uvec2(stepWords[at], stepWords[at + 1])));
}
