// What the host's depth texture shows, as an obstacle: formula depth-contact in rendering/gpu_particles/gpu_depth.h. Part of
// gpu_particle_contacts.glsl. Numbers: thickness, margin.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along each pixel's ray; infinite where nothing is seen

const int kMaxDepthSamples = 16;
const int kMaxBisections = 12;

struct SeenPlane
{
    bool isKnown;   // within the window
    float error;    // [m] e
    float distance; // [m] d
    float behind;   // [m] b
    vec3 normal;    // in the camera's axes, towards the camera
};

bool isParallelDepth() { return depthSize.z > 0.5; }
vec3 turnedToCamera(vec3 v) { return vec3(dot(depthRight.xyz, v), dot(depthUp.xyz, v), dot(depthForward.xyz, v)); }
vec3 placeInCamera(vec3 p) { return turnedToCamera(p) + vec3(depthRight.w, depthUp.w, depthForward.w); }
vec2 windowOf(vec3 c) { return depthWindow.xy * (isParallelDepth() ? c.xy : c.xy / c.z) + depthWindow.zw; }

// q of a texel, and whether it shows anything.
float seenAt(ivec2 texel, out bool isSeen)
{
    bool isInside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(depthSize.xy)));
    float range = isInside ? texelFetch(sceneDistance, texel, 0).r : 1e30;
    isSeen = abs(range) < 1e30;
    if (isParallelDepth())
        return range;
    vec2 slope = (vec2(texel) + 0.5 - depthWindow.zw) / depthWindow.xy;
    return sqrt(dot(slope, slope) + 1.0) / max(range, 1e-30);
}

// (2)
float changeOf(ivec2 texel, ivec2 way, float middle)
{
    bool isLowSeen;
    bool isHighSeen;
    float low = middle - seenAt(texel - way, isLowSeen);
    float high = seenAt(texel + way, isHighSeen) - middle;
    if (isLowSeen && isHighSeen)
        return abs(low) < abs(high) ? low : high;
    return isLowSeen ? low : (isHighSeen ? high : 0.0);
}

SeenPlane lookAt(vec3 c, float margin)
{
    SeenPlane seen = SeenPlane(false, 0.0, 1e30, -1e30, vec3(0.0, 0.0, -1.0));
    vec2 window = windowOf(c);
    if (!(c.z > 0.0 || isParallelDepth()) || !all(greaterThanEqual(window, vec2(0.0))) || !all(lessThan(window, depthSize.xy)))
        return seen;
    seen.isKnown = true;
    seen.error = depthError.x + abs(c.z) * (depthError.y + abs(c.z) * depthError.z);
    ivec2 texel = ivec2(window);
    bool isSeen;
    float q = seenAt(texel, isSeen);
    if (!isSeen)
        return seen;
    vec2 change = vec2(changeOf(texel, ivec2(1, 0), q), changeOf(texel, ivec2(0, 1), q));
    vec3 n = vec3(change * depthWindow.xy, q + dot(change, depthWindow.zw - vec2(texel) - 0.5)); // (1)
    if (isParallelDepth()) {
        seen.behind = c.z - dot(n, vec3(c.xy, 1.0));
        n.z = -1.0;
        seen.normal = n / length(n);
        seen.distance = -seen.behind / length(n) - margin;
        return seen;
    }
    float size = length(n);
    float along = dot(n, c);
    seen.normal = -n / size; // (3)
    seen.distance = (1.0 - along) / size - margin;
    seen.behind = along > 0.0 ? c.z * (along - 1.0) / along : -1e30;
    return seen;
}

// A way in the camera's axes, and how deep it may go inside.
vec3 wayFrom = vec3(0.0);
vec3 wayV = vec3(0.0);
vec3 wayA = vec3(0.0);
float waySunk = 0.0;

vec3 wayAt(float time) { return wayFrom + time * (wayV + 0.5 * time * wayA); }

int looksAt(float seconds)
{
    vec3 end = wayAt(seconds);
    if (!isParallelDepth() && !(min(wayFrom.z, end.z) > 0.0))
        return kMaxDepthSamples;
    return int(clamp(ceil(0.5 * length(windowOf(end) - windowOf(wayFrom))), 1.0, float(kMaxDepthSamples)));
}

// When the way from `low` on reaches the plane that has been seen from its place at `high`; half way where it does not.
float reachOf(SeenPlane seen, float low, float high)
{
    float half1 = 0.5 * (low + high);
    float d = seen.distance + dot(seen.normal, wayAt(low) - wayAt(high)) + waySunk;
    float v = dot(seen.normal, wayV + low * wayA);
    float a = 0.5 * dot(seen.normal, wayA);
    float inside = v * v - 4.0 * a * d;
    if (d <= 0.0 && v < 0.0)
        return low; // it is there
    if (!(d >= 0.0) || inside < 0.0 || (v >= 0.0 && a >= 0.0))
        return half1;
    float root = sqrt(inside);
    float time = low + (v < 0.0 ? 2.0 * d / (root - v) : (v + root) / (-2.0 * a));
    return time > low && time < high ? time : half1;
}

// By more than what rounding leaves of a velocity along a surface.
bool leadsIn(float time, vec3 normal)
{
    vec3 v = wayV + time * wayA;
    return dot(normal, v) < -1e-6 * length(v);
}

// (4). @param io in: from where inside was seen; out: of what is met
bool findContact(float low, float high, float thickness, float margin, inout SeenPlane io, out float time)
{
    for (int k = 0; k < kMaxBisections; ++k) {
        time = (k & 1) == 0 ? reachOf(io, low, high) : 0.5 * (low + high);
        SeenPlane seen = lookAt(wayAt(time), margin);
        if (!seen.isKnown)
            return false;
        bool isHere = abs(seen.distance + waySunk) <= seen.error;
        if (isHere && leadsIn(time, seen.normal)) {
            io = seen;
            return true;
        }
        bool isIn = !isHere && seen.distance + waySunk < 0.0;
        if (isIn)
            io = seen;
        high = isIn ? time : high;
        low = isIn ? low : time;
    }
    time = low;
    return io.behind <= thickness && leadsIn(low, io.normal);
}

// @return whether anything is met in `seconds`
bool followDepth(int n, vec3 from, vec3 v, vec3 a, float seconds, out float time, out vec3 normal, out float lift)
{
    float thickness = moduleNumbers[n] * depthSize.w;
    float margin = moduleNumbers[n + 1] * depthSize.w;
    wayFrom = placeInCamera(from);
    wayV = turnedToCamera(v);
    wayA = turnedToCamera(a);
    waySunk = 0.0;
    time = 0.0;
    normal = vec3(0.0);
    SeenPlane seen;
    bool isBegun = false; // where it begins is looked at when that matters
    bool isFront = true;  // the look before was
    bool isMet = false;
    int looks = looksAt(seconds);
    float before = 0.0;
    for (int i = 1; i <= looks && !isMet; ++i) {
        float at = i == looks ? seconds : seconds * (float(i) / float(looks));
        seen = lookAt(wayAt(at), margin);
        bool isIn = seen.isKnown && seen.distance + 2.0 * seen.error < 0.0;
        if (isIn && !isBegun) { // (5)
            SeenPlane first = lookAt(wayFrom, margin);
            isBegun = true;
            bool mayMeet = first.isKnown && (first.distance > 0.0 || first.behind <= thickness);
            waySunk = mayMeet ? max(-first.distance, 0.0) : 0.0;
            isFront = i == 1 ? mayMeet : isFront;
        }
        isIn = isIn && seen.distance + 1.0001 * waySunk + 0.25 * seen.error < 0.0;
        SeenPlane met = seen;
        if (isIn && isFront)
            isMet = findContact(before, at, thickness, margin, met, time);
        isFront = seen.isKnown && (!isIn || (isFront && seen.behind <= thickness));
        if (isIn && isFront)
            waySunk = max(-seen.distance, 0.0); // it leads out of a surface that has come nearer
        seen = met;
        before = at;
    }
    // (6)
    lift = isMet && -seen.distance <= 3.0 * seen.error ? clamp(-seen.distance, 0.0, seen.error) / depthSize.w : 0.0;
    if (isMet)
        normal = normalize(seen.normal.x * depthRight.xyz + seen.normal.y * depthUp.xyz + seen.normal.z * depthForward.xyz);
    return isMet;
}

void meetDepth(int n)
{
    float time;
    vec3 normal;
    float lift;
    if (!(depthSize.x > 0.0) || !followDepth(n, legFrom, legV, legA, legSeconds, time, normal, lift))
        return;
    precise vec3 place = legFrom + time * (legV + 0.5 * time * legA) + lift * normal;
    meetAt(kDepth, n, min(time / legSeconds, 1.0), place, normal);
}

// Those that touch nothing move as if there were no depth, bit for bit.
void askNearDepth(int n)
{
    if (isNear || !(depthSize.x > 0.0) || !(atSeconds > 0.0))
        return;
    vec3 mean = (atX - fromX) / atSeconds;
    vec3 v = 2.0 * mean - atV;
    float time;
    vec3 normal;
    float lift;
    isNear = followDepth(n, fromX, v, (atV - v) / atSeconds, atSeconds, time, normal, lift);
}
