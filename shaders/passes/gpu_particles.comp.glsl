// The rows of an emitter that the CPU has only counted: one thread a row, each from nothing but its number and the moment.
//
// FX_SHAPE GpuShape; FX_TURNED 1: about another axis than +Y; FX_FRAMES GpuFrames; FX_BRIEF 1: ages fit into 32 bits of ticks; FX_LIFE_VARIES 1: each has its own
// lifetime; FX_DRAGS 1: with drag; FX_BY_SPEED 1: curves over speed; FX_VELOCITY, FX_ANGLE, FX_FRAME, FX_ORIENTATION 1: these
// columns are written.
layout(local_size_x = 256) in;

#include "shared/gpu_particle_random.glsl"
#include "shared/gpu_particle_words.glsl"
#include "shared/gpu_particle_motion.glsl"

layout(std430, binding = 2) writeonly buffer OutputRows { uint rowWords[]; };
layout(std140, binding = 0) uniform Output
{
    ivec4 columnAt[4]; // places of the columns in words of 4 bytes; -1: not there
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

// (1) of birth-shapes
vec3 coneDirection(float u1, float u2, float limit)
{
    precise float cosine = 1.0 - u1 * (1.0 - limit);
    precise float squared = max((1.0 - cosine) * (1.0 + cosine), 0.0);
    precise float sine = sqrt(squared);
    vec2 azimuth = sinCosTurns(u2);
    precise vec3 direction = vec3(sine * azimuth.y, cosine, sine * azimuth.x);
    return direction;
}

// even-shapes, (2)
float discRadius(float u)
{
    precise float squared = inner * inner + u * (1.0 - inner * inner);
    return sqrt(squared);
}
vec3 onCircle(float turns)
{
    vec2 azimuth = sinCosTurns(turns);
    return vec3(azimuth.y, 0.0, azimuth.x);
}

// shortest-turn
vec3 turnedFromY(vec3 v)
{
    vec3 a = vec3(axis[0], axis[1], axis[2]);
    float squared = a.x * a.x + a.z * a.z;
    if (a.y < 0.0 && squared < 1e-12)
        return vec3(v.x, -v.y, -v.z);
    if (squared == 0.0)
        return v;
    vec3 w = vec3(a.z, 0.0, -a.x);
    vec3 once = cross(w, v);
    return v + once + cross(w, once) / (1.0 + a.y);
}

const vec3 kUp = vec3(0.0, 1.0, 0.0);

// Around the origin, along +Y.
void bearUpright(uvec2 index, out vec3 place, out vec3 direction)
{
    place = vec3(0.0);
#if FX_SHAPE != 0
    vec4 u = drawn(index, kPosition);
#endif
#if FX_SHAPE == 0 || FX_SHAPE == 3 || FX_SHAPE == 5
    vec4 heading = drawn(index, kDirection);
#endif
#if FX_SHAPE == 0
    direction = coneDirection(heading.x, heading.y, -1.0);
#elif FX_SHAPE == 1
    direction = coneDirection(u.x, u.y, -1.0);
    precise float k = inner * inner * inner;
    precise float r = size[0] * cubeRoot(k + u.z * (1.0 - k));
    precise vec3 there = r * direction;
    place = there;
#elif FX_SHAPE == 2
    direction = kUp;
    precise vec3 there = vec3(size[0], size[1], size[2]) * (u.xyz + u.xyz - 1.0);
    place = there;
#elif FX_SHAPE == 3
    direction = coneDirection(heading.x, heading.y, cosLimit);
    precise float r = size[0] * discRadius(u.y);
    precise vec3 there = r * onCircle(u.x);
    place = there;
#elif FX_SHAPE == 4
    vec3 extents = vec3(size[0], size[1], size[2]);
    vec3 area = extents.yzx * extents.zxy;
    float sum = area.x + area.y + area.z;
    float pick = 2.0 * u.w * sum; // (6) of even-shapes
    float side = pick < sum ? 1.0 : -1.0;
    float rest = pick < sum ? pick : pick - sum;
    int face = rest < area.x ? 0 : (rest < area.x + area.y ? 1 : 2);
    place = extents * (2.0 * u.xyz - 1.0);
    place[face] = side * extents[face];
    direction = vec3(0.0);
    direction[face] = side;
#elif FX_SHAPE == 5
    place = size[0] * (2.0 * u.x - 1.0) * kUp;
    direction = onCircle(heading.x);
#elif FX_SHAPE == 6
    direction = kUp;
    place = size[0] * discRadius(u.y) * onCircle(u.x);
#else
    float r = tube * discRadius(u.z); // (5) of even-shapes
    vec2 around = sinCosTurns(u.y);
    float lean = size[0] > 0.0 ? r / size[0] : 0.0;
    float cosine = u.w < 0.5 * (1.0 - lean * around.y) ? 0.0 - around.y : around.y; // (4)
    vec3 outward = onCircle(u.x);
    direction = cosine * outward + around.x * kUp;
    place = size[0] * outward + r * direction;
#endif
}

void bear(uvec2 index, out vec3 x, out vec3 direction)
{
    vec3 place;
    bearUpright(index, place, direction);
#if FX_TURNED
    place = turnedFromY(place);
    direction = turnedFromY(direction);
#endif
    precise vec3 there = place + vec3(position[0], position[1], position[2]);
    x = there;
}

// perLifeOf() of simulation/particles/particle_program.cpp; the division is rounded as the CPU's.
float perLifeOf(float seconds)
{
    if (!(seconds > 0.0))
        return 1e30;
    return float(1.0lf / double(clamp(seconds, 1e-30, 1e9)));
}

float curveOfLife(int channel, float place, int piece)
{
    int at = channel * kCurveSamples + piece;
    precise float value = lifeCurves[at] + place * (lifeCurves[at + 1] - lifeCurves[at]);
    return value;
}
float curveOfSpeed(int channel, float place, int piece)
{
    int at = channel * kCurveSamples + piece;
    precise float value = speedCurves[at] + place * (speedCurves[at + 1] - speedCurves[at]);
    return value;
}
// Which piece of a curve `t` is in, and how far.
float placeOf(float t, out int piece)
{
    precise float s = clamp(t, 0.0, 1.0) * 64.0;
    piece = min(int(s), 63);
    precise float place = s - float(piece);
    return place;
}

// half-floats, (1) and (2); what packHalf2x16 rounds to is up to the driver
uint halfOf(float x)
{
    float bounded = min(max(x, 0.0), 65504.0);
    uint bits = floatBitsToUint(bounded);
    precise float lifted = bounded + 0.5;
    if (bounded < 6.103515625e-5)
        return floatBitsToUint(lifted) - (126u << 23);
    return (bits - (112u << 23) + 0xFFFu + ((bits >> 13) & 1u)) >> 13;
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
    float place = placeOf(life, piece);
    precise float size1 = ofRange(radius[0], radius[1], u.x) * max(curveOfLife(4, place, piece), 1e-4);
    precise float cover = ofRange(opacity[0], opacity[1], u.y) * curveOfLife(3, place, piece);
    precise vec3 color = vec3(curveOfLife(0, place, piece), curveOfLife(1, place, piece), curveOfLife(2, place, piece));
#if FX_BY_SPEED
    place = placeOf(length(v) * perFastest, piece);
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
    precise vec3 axis = sinCos.x * coneDirection(w.x, w.y, -1.0);
    putVector(11, row, axis);
    put(14, row, sinCos.y);
#endif
#endif
}

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
    vec3 direction;
    bear(index, x, direction);
    precise vec3 v = ofRange(speed[0], speed[1], u.y) * direction;
    vec3 velocity = v;
    fly(ticks, x, velocity);
    putVector(0, row, x);
    put(3, row, age);
#if FX_VELOCITY
    putVector(6, row, velocity);
#endif
    writeLook(row, index, life, velocity);
    writeTurn(row, index, age, life);
}
