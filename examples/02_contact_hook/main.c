/* Particles that bounce off geometry which only the host knows: here a plane that is tilted by 30 degrees.
 * Prints how near to the plane any particle came, and fails when one has passed it. No picture, no GL. */
#include "fxsdk/fxsdk.h"

#include <stdio.h>

/* The host's world: everything with a dot product below `offset` is solid. */
typedef struct Plane
{
    double normal[3];
    double offset;
} Plane;

static double heightAbove(const Plane* plane, const double p[3])
{
    return plane->normal[0] * p[0] + plane->normal[1] * p[1] + plane->normal[2] * p[2] - plane->offset;
}

/* Several threads ask at once: the plane is only read. */
static int meetPlane(void* user, const double from[3], const double to[3], float* outShare,
                     float outNormal[3])
{
    const Plane* plane = (const Plane*)user;
    const double begin = heightAbove(plane, from), end = heightAbove(plane, to);
    int i;
    if (end >= 0.0 || begin < end)
        return 0; /* free, or on its way out */
    *outShare = begin > 0.0 ? (float)(begin / (begin - end)) : 0.0f;
    for (i = 0; i < 3; ++i)
        outNormal[i] = (float)plane->normal[i];
    return 1;
}

static const char kHail[] =
    "{\"version\": 1, \"ground\": false, \"emitters\": [{\"name\": \"hail\", \"maxParticles\": 2000,"
    " \"shape\": \"disc\", \"position\": [0, 6, 0], \"size\": 3, \"emission\": {\"rate\": 400}, "
    "\"lifetime\": 4,"
    " \"radius\": 0.02, \"appearance\": {\"kind\": \"sprite\"},"
    " \"collisions\": [{\"shape\": \"hook\", \"bounce\": 0.6, \"friction\": 0.1}]}]}";

/* Values of a column of the first group, or null. */
static const float* column(FxScene* scene, FxSnapshotId snapshot, const char* name, uint32_t* outCount)
{
    FxSnapshotColumn found;
    found.structSize = sizeof found;
    if (fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, 0, name, &found))
        return NULL;
    *outCount = found.count;
    return found.values;
}

/* The lowest height above the plane of all particles that are shown; the instance stands at the origin. */
static int lowest(FxScene* scene, const Plane* plane, double* ioLowest)
{
    FxSnapshotId snapshot;
    uint32_t count = 0, i;
    const float *x, *y, *z, *radius;
    if (fxScene_AcquireSnapshot(scene, &snapshot))
        return 1;
    x = column(scene, snapshot, "x", &count);
    y = column(scene, snapshot, "y", &count);
    z = column(scene, snapshot, "z", &count);
    radius = column(scene, snapshot, "radius", &count); /* 0: the row is empty */
    for (i = 0; x && y && z && radius && i < count; ++i) {
        const double place[3] = {x[i], y[i], z[i]};
        if (radius[i] > 0.0f && heightAbove(plane, place) < *ioLowest)
            *ioLowest = heightAbove(plane, place);
    }
    return !x || fxScene_ReleaseSnapshot(scene, snapshot) != FX_OK;
}

int main(void)
{
    Plane plane = {{-0.5, 0.8660254, 0.0}, 0.0};
    FxContextDef contextDef = fxDefaultContextDef();
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    FxContactHook hook = fxDefaultContactHook();
    FxContext* context = NULL;
    FxScene* scene = NULL;
    FxInstanceId instance;
    double least = 1e9;
    int frame;
    hook.meet = meetPlane;
    hook.user = &plane;
    if (fxCreateContext(&contextDef, &context) ||
        fxLoadPresetText(context, kHail, sizeof kHail - 1, "hail", &instanceDef.preset) ||
        fxCreateScene(context, &sceneDef, &scene) || fxScene_SetContactHook(scene, &hook) ||
        fxScene_CreateInstance(scene, &instanceDef, &instance))
    {
        fprintf(stderr, "%s\n", fxGetLastErrorMessage());
        return 1;
    }
    for (frame = 0; frame < 240; ++frame)
        if (fxScene_Update(scene, 1.0 / 60.0) || lowest(scene, &plane, &least)) {
            fprintf(stderr, "%s\n", fxGetLastErrorMessage());
            return 1;
        }
    printf("nearest to the plane: %.4f m\n", least);
    fxDestroyContext(context);
    return least > -1e-3 && least < 0.1 ? 0 : 1; /* they get there, and none passes */
}
