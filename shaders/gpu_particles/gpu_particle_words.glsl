// What an emitter publishes for the GPU: foundation/snapshot/gpu_particles.h, which has the same layout. 64-bit numbers are
// uvec2, low word first.
const int kCurveSamples = 65;
const int kCurvePieces = 10;

layout(std430, binding = 0) readonly buffer EmitterNumbers
{
    float position[3];
    float size[3];
    float axis[3];
    float cosLimit;
    float inner;
    float tube;
    float speed[2];
    float lifetime[2];
    float perLifeOfAll;
    float radius[2];
    float opacity[2];
    float brightness[2];
    float angle[2];
    float spin[2];
    float frame[2];
    float drag;
    float perDrag;
    float frames;
    float framesPerSecond;
    float perFastest;
    float coneHeight;
    float coneSlope[3];
    float lifeCurves[5 * kCurveSamples];
    float speedCurves[5 * kCurveSamples];
    float moduleNumbers[]; // where there are modules
};
layout(std430, binding = 1) readonly buffer MomentWords { uint words[]; };

const int kMomentWords = 14;
const int kRunWords = 12;
const int kConditionWords = 6;

uvec2 pairAt(int at) { return uvec2(words[at], words[at + 1]); }
uvec2 seedOf() { return pairAt(0); }
uvec2 nextIndex() { return pairAt(2); }
uint solverIndex() { return words[6]; }
uint rowCount() { return words[7]; }
uint nextRow() { return words[8]; }
uint windowCount() { return words[9]; }
int runCount() { return int(words[10]); }
int conditionCount() { return int(words[11]); }
int runAt(int i) { return kMomentWords + i * kRunWords; }
int conditionAt(int i) { return kMomentWords + runCount() * kRunWords + i * kConditionWords; }

uvec2 add64(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}
uvec2 sub64(uvec2 a, uvec2 b)
{
    uint borrow;
    uint low = usubBorrow(a.x, b.x, borrow);
    return uvec2(low, a.y - b.y - borrow);
}
bool isPositive(uvec2 a) { return int(a.y) > 0 || (a.y == 0u && a.x > 0u); }

// Low 64 bits of a product.
uvec2 mul64(uvec2 a, uint b)
{
    uint high, low;
    umulExtended(a.x, b, high, low);
    return uvec2(low, high + a.y * b);
}

// The whole part of rest + j * fraction, both of 96 bits behind the point.
uint carryOf(int rest, int fraction, uint j)
{
    uint above = 0u; // what the words so far carry into the next
    for (int i = 0; i < 3; ++i) {
        uint high, low, carry0, carry1;
        umulExtended(words[fraction + i], j, high, low);
        low = uaddCarry(low, words[rest + i], carry0);
        low = uaddCarry(low, above, carry1);
        above = high + carry0 + carry1; // < 2^32: the sum of all is below 2^128
    }
    return above;
}

// [tick] The age of the birth whose index lies `distance` before the next; (1) of birth-runs.
uvec2 ageOfBirth(uint distance)
{
    int run = 0;
    int count = runCount();
    for (int i = 1; i < count; ++i) // the same way for all, which is mostly none
        run = distance <= words[runAt(i)] ? i : run;
    int at = runAt(run);
    uint j = words[at] - distance;
    uvec2 since = mul64(pairAt(at + 4), j);
    since = add64(since, uvec2(carryOf(at + 9, at + 6, j), 0u));
    return sub64(pairAt(at + 2), since);
}

// [s]
float secondsOf(uvec2 ticks)
{
#if FX_BRIEF
    if (ticks.y != 0u)
        return 1e9; // longer than any lifetime
    precise float seconds = (float(ticks.x >> 16) * 65536.0 + float(ticks.x & 0xFFFFu)) * 1.41723355e-09;
    return seconds;
#else
    precise double wide = double(ticks.y) * 4294967296.0lf + double(ticks.x);
    precise double seconds = wide * 1.4172335600907028e-09lf;
    return float(seconds);
#endif
}
