// Collisions, operation by operation as simulation/particles/ground_lanes.cpp and simulation/particles/collisions/ have them: swept, so
// that nothing is passed. FX_NEAR, FX_MEET, FX_PUSH and FX_INSIDE call a function of theirs once for each obstacle; where there is
// none they are not defined. `kind` is a base::GpuModule and the same for all particles.
const int kPlane = 16;
const int kGround = 17;
const int kSphere = 18;
const int kBox = 19;
const int kDepth = 20;

vec3 fromX = vec3(0.0); // where the part of the step began
vec3 fromV = vec3(0.0);
bool isStuck = false;
bool isKilled = false;

float stepGround() { return stepFloat(10); }

// ground-bounce; numbers: restitution, friction
void meetBounce(int n, int w)
{
    float height = stepGround();
    if (!(atX.y < height))
        return;
    precise float drop = fromX.y - atX.y;
    precise float above = fromX.y - height;
    precise float met = min(max(above / drop, 0.0), 1.0);
    precise float f = drop > 0.0 ? met : 0.0; // (1)
    precise float rest = 1.0 - f;
    precise vec3 change = atV - fromV;
    precise float way = rest * atSeconds;
    precise float bend = 0.5 * rest * rest * atSeconds;
    precise vec3 v = fromV + f * change; // (2)
    precise float grip = 1.0 - moduleNumbers[n + 1];
    v = vec3(v.x * grip, max(-moduleNumbers[n] * v.y, 0.0), v.z * grip);
    precise vec3 x = fromX + f * (atX - fromX);
    x = x + (way * v + bend * change); // (3)
    v = v + rest * change;
    bool lies = x.y <= height; // (4)
    atX = lies ? vec3(x.x, height, x.z) : x;
    atV = lies ? vec3(v.x, 0.0, v.z) : v;
}

#ifdef FX_MEET

const int kMaxContacts = 8;
const int kMaxPushOuts = 4;

// The leg: a way through a part of the step.
precise vec3 legFrom = vec3(0.0);
precise vec3 legTo = vec3(0.0);
precise vec3 legV = vec3(0.0);
precise vec3 legA = vec3(0.0);
precise float legSeconds = 0.0;
// What it meets first.
int metAt = -1; // place of response, restitution and friction; -1: nothing
float metShare = 0.0;
vec3 metPlace = vec3(0.0);
vec3 metNormal = vec3(0.0);
// A place that is moved out of matter.
precise vec3 pushed = vec3(0.0);
bool isOut = false;

#include "gpu_particles/gpu_particle_obstacles.glsl"
#if FX_DEPTH
#include "gpu_particles/gpu_particle_depth.glsl"
#endif

// ---- contact-path ----

void finishLeg()
{
    atX = legTo;
    atV = legV + legSeconds * legA;
    pushed = legTo;
    pushOut();
    atX = isOut ? pushed : legFrom; // (4)
}

// @return true when the way ends here
bool answer(int contacts)
{
    precise float spent = metShare * legSeconds;
    precise vec3 v = legV + spent * legA;
    precise vec3 place = metPlace + liftAt(metPlace) * metNormal;
    float response = moduleNumbers[metAt];
    if (response != 0.0) {
        isKilled = response == 1.0;
        isStuck = response == 2.0;
        atX = metPlace;
        atV = isKilled ? v : vec3(0.0);
        return true;
    }
    float approach = dotOf(v, metNormal);
    if (approach < 0.0)
        v = (1.0 - moduleNumbers[metAt + 2]) * (v - approach * metNormal) - moduleNumbers[metAt + 1] * approach * metNormal; // (2)
    legSeconds = legSeconds - spent;
    precise float sinking = -dotOf(legA, metNormal) * legSeconds;
    float leaving = dotOf(v, metNormal);
    if (contacts + 2 >= kMaxContacts || 0.0009765625 * sinking > leaving) { // (3)
        v = v - leaving * metNormal;
        legA = legA - min(dotOf(legA, metNormal), 0.0) * metNormal;
    }
    legFrom = place;
    legV = v;
    legTo = legFrom + legSeconds * (legV + 0.5 * legSeconds * legA);
    if (legSeconds > 0.0)
        return false;
    finishLeg();
    return true;
}

void followPath()
{
    findBall();
    FX_NEAR
    if (!isNear || !(atSeconds > 0.0))
        return;
    legFrom = fromX;
    legTo = atX;
    legSeconds = atSeconds;
    precise vec3 mean = (atX - fromX) / atSeconds;
    legV = 2.0 * mean - atV;
    legA = (atV - legV) / atSeconds; // (1)
    pushed = legFrom;
    pushOut();
    legFrom = pushed;
    for (int contacts = 0; contacts <= kMaxContacts; ++contacts) {
        metAt = -1;
        FX_MEET
        if (metAt < 0) {
            finishLeg();
            return;
        }
        if (answer(contacts))
            return;
    }
    atX = legFrom;
    atV = vec3(0.0);
}

#endif
