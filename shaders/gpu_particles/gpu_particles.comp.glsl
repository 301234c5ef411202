// The rows of an emitter that the CPU has only counted: one thread a row, each from nothing but its number and the moment.
//
// FX_FRAMES GpuFrames; FX_BRIEF 1: ages fit into 32 bits of ticks; FX_LIFE_VARIES 1: each has its own lifetime; FX_DRAGS 1: with drag;
// FX_BY_SPEED 1: curves over speed; FX_VELOCITY, FX_ANGLE, FX_FRAME, FX_ORIENTATION 1: these columns are written; FX_STEPS 1: motion
// is stepped, see shared/gpu_particle_steps.glsl; FX_DEPTH 1: it meets what the depth texture shows.
layout(local_size_x = 256) in;

#include "gpu_particles/gpu_particle_random.glsl"
#include "gpu_particles/gpu_particle_words.glsl"
#include "gpu_particles/gpu_particle_motion.glsl"

layout(std430, binding = 2) writeonly buffer OutputRows { uint rowWords[]; };
layout(std140, binding = 0) uniform Output
{
    ivec4 columnAt[4]; // places of the columns in words of 4 bytes; -1: not there
    uvec4 chain;       // steps [x, y) are taken; z 1: they are the last
#if FX_DEPTH
    vec4 depthRight; // local place and 1 to the axes of the camera that has seen the depth texture [m]
    vec4 depthUp;
    vec4 depthForward;
    vec4 depthWindow; // xy: pixels per slope, or per metre; zw: pixel of the view axis
    vec4 depthError;  // e = x + y z + z z^2 [m] at the distance z along the axis
    vec4 depthSize;   // xy: [pixel], 0 where there is none; z: 1 parallel; w: [m] per local length
#endif
};

// RandomPurpose
const uint kPosition = 1u;
const uint kDirection = 2u;
const uint kLife = 3u;
const uint kAttributes = 4u;
const uint kSpin = 7u;
const uint kAxis = 8u;

vec4 drawn(uvec2 index, uint purpose)
{
    return unitFloats(philox(uvec4(index, solverIndex(), purpose), seedOf()));
}

#if FX_STEPS
#include "gpu_particles/gpu_particle_steps.glsl"
#endif

void put(int column, uint row, float value) { rowWords[columnAt[column >> 2][column & 3] + int(row)] = floatBitsToUint(value); }
void putVector(int column, uint row, vec3 value)
{
    put(column, row, value.x);
    put(column + 1, row, value.y);
    put(column + 2, row, value.z);
}
void putColor(uint row, uvec2 color)
{
    int at = columnAt[1][1] + 2 * int(row);
    rowWords[at] = color.x;
    rowWords[at + 1] = color.y;
}

#include "gpu_particles/gpu_particle_births.glsl"
#include "gpu_particles/gpu_particle_appearance.glsl"

// perLifeOf() of simulation/particles/particle_program.cpp; the division is rounded as the CPU's.
float perLifeOf(float seconds)
{
    if (!(seconds > 0.0))
        return 1e30;
    return float(1.0lf / double(clamp(seconds, 1e-30, 1e9)));
}

void writeNobody(uint row)
{
    putVector(0, row, vec3(0.0));
    put(3, row, 0.0);
    put(4, row, 0.0);
    putColor(row, uvec2(0u));
#if FX_VELOCITY
    putVector(6, row, vec3(0.0));
#endif
#if FX_ANGLE
    put(9, row, 0.0);
#endif
#if FX_FRAME
    put(10, row, 0.0);
#endif
#if FX_ORIENTATION
    putVector(11, row, vec3(0.0));
    put(14, row, 0.0);
#endif
}

void writeLook(uint row, uvec2 index, float life, vec3 v)
{
    vec4 u = drawn(index, kAttributes);
    int piece;
    float place = placeInLife(life, piece);
    precise float size1 = ofRange(radius[0], radius[1], u.x) * max(curveOfLife(4, place, piece), 1e-4);
    precise float cover = ofRange(opacity[0], opacity[1], u.y) * curveOfLife(3, place, piece);
    precise vec3 color = vec3(curveOfLife(0, place, piece), curveOfLife(1, place, piece), curveOfLife(2, place, piece));
#if FX_BY_SPEED
    precise float speed = min(lengthOf(v) * perFastest, 1.0);
    place = placeInSpeed(speed, piece);
    size1 = size1 * max(curveOfSpeed(4, place, piece), 1e-4);
    cover = cover * curveOfSpeed(3, place, piece);
    color = color * vec3(curveOfSpeed(0, place, piece), curveOfSpeed(1, place, piece), curveOfSpeed(2, place, piece));
#endif
    color = color * ofRange(brightness[0], brightness[1], u.w);
    put(4, row, size1);
    putColor(row, uvec2(halfOf(color.r) | (halfOf(color.g) << 16),
                        halfOf(color.b) | (halfOf(clamp(cover, 0.0, 1.0)) << 16)));
}

void writeTurn(uint row, uvec2 index, float age, float life)
{
#if FX_ANGLE || FX_FRAME || FX_ORIENTATION
    vec4 u = drawn(index, kSpin);
    precise float turned = ofRange(angle[0], angle[1], u.x) + ofRange(spin[0], spin[1], u.y) * age;
#if FX_ANGLE
    put(9, row, turned);
#endif
#if FX_FRAME
    precise float shown = ofRange(frame[0], frame[1], u.z);
#if FX_FRAMES == 1
    shown = shown + life * frames;
#elif FX_FRAMES == 2
    precise float gone = shown + age * framesPerSecond;
    shown = gone - floor(gone * (1.0 / frames)) * frames;
#endif
    put(10, row, shown);
#endif
#if FX_ORIENTATION
    vec4 w = drawn(index, kAxis);
    precise float halfTurns = turned * 0.0795774715;
    vec2 sinCos = sinCosTurns(halfTurns);
    precise vec3 axis = sinCos.x * aroundY(w.x, -1.0, sinCosTurns(w.y));
    putVector(11, row, axis);
    put(14, row, sinCos.y);
#endif
#endif
}

#if FX_STEPS
// @return false when the particle has died before its time
bool stepThrough(uint row, uvec2 index, uvec2 age, float perLife, float speedAtBirth, out vec3 x, out vec3 v)
{
    isStuck = isKilled = false;
    atIndex = index;
    if (isReached(age, chain.x)) {
        atX = reachedVector(0u, row);
        atV = reachedVector(3u, row);
        uint flags = reached[reachedAt(6u, row)];
        isStuck = (flags & 1u) != 0u;
        isKilled = (flags & 2u) != 0u;
    } else {
        vec3 place;
        vec3 direction;
        bear(index, place, direction);
        atX = place;
        atV = speedAtBirth * direction;
    }
    for (uint i = chain.x; i < chain.y; ++i)
        takeStep(i, age, perLife);
    keepVector(0u, row, atX);
    keepVector(3u, row, atV);
    reached[reachedAt(6u, row)] = (isStuck ? 1u : 0u) | (isKilled ? 2u : 0u);
    x = atX;
    v = atV;
    return !isKilled;
}
#endif

void main()
{
    uint row = gl_GlobalInvocationID.x;
    if (row >= rowCount())
        return;
    uint distance = nextRow() > row ? nextRow() - row : nextRow() + rowCount() - row;
    if (distance > windowCount()) {
        writeNobody(row);
        return;
    }
    uvec2 index = sub64(nextIndex(), uvec2(distance, 0u));
    uvec2 ticks = ageOfBirth(distance);
    vec4 u = drawn(index, kLife);
#if FX_LIFE_VARIES
    float perLife = perLifeOf(ofRange(lifetime[0], lifetime[1], u.x));
#else
    float perLife = perLifeOfAll;
#endif
    precise float age = secondsOf(ticks);
    precise float life = age * perLife;
    if (!(life < 1.0)) {
        writeNobody(row);
        return;
    }
    vec3 x;
    vec3 velocity;
#if FX_STEPS
    bool lives = stepThrough(row, index, ticks, perLife, ofRange(speed[0], speed[1], u.y), x, velocity);
    if (chain.z == 0u)
        return;
    if (!lives) {
        writeNobody(row);
        return;
    }
#else
    vec3 direction;
    bear(index, x, direction);
    precise vec3 v = ofRange(speed[0], speed[1], u.y) * direction;
    velocity = v;
    fly(ticks, x, velocity);
#endif
    putVector(0, row, x);
    put(3, row, age);
#if FX_VELOCITY
    putVector(6, row, velocity);
#endif
    writeLook(row, index, life, velocity);
    writeTurn(row, index, age, life);
}
