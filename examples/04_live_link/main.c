/* A game without a picture that runs one effect in real time and prints what it does. With --link it can be
 * changed while it runs:
 *     04_live_link my-effect.fx.json --link my-game &
 *     fx edit my-effect.fx.json --link my-game
 * The lines marked "link" are all that a game needs; a game would compile them in development builds only. */
#define _POSIX_C_SOURCE 199309L
#include "fxsdk/fx_livelink.h" /* link */
#include "fxsdk/fxsdk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct Options
{
    const char* preset;
    const char* link; /* name of the game; null: no link */
    int frames;       /* 0: without end */
} Options;

static int readOptions(int count, char** arguments, Options* out)
{
    int i;
    out->preset = NULL;
    out->link = NULL;
    out->frames = 0;
    for (i = 1; i < count; ++i) {
        if (!strcmp(arguments[i], "--link") && i + 1 < count)
            out->link = arguments[++i];
        else if (!strcmp(arguments[i], "--frames") && i + 1 < count)
            out->frames = atoi(arguments[++i]);
        else
            out->preset = arguments[i];
    }
    return out->preset != NULL;
}

/* Values of a column of a group, or null. */
static const float* column(FxScene* scene, FxSnapshotId snapshot, uint32_t group, const char* name,
                           uint32_t* outCount)
{
    FxSnapshotColumn found;
    found.structSize = sizeof found;
    if (fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, group, name, &found))
        return NULL;
    *outCount = found.count;
    return found.values;
}

/* Prints how many particles are shown, and how high they are. */
static void printParticles(FxScene* scene, int frame)
{
    FxSnapshotId snapshot;
    FxSnapshotInfo info;
    uint32_t group, i, count = 0, particles = 0;
    double height = 0.0;
    info.structSize = sizeof info;
    if (fxScene_AcquireSnapshot(scene, &snapshot))
        return;
    if (!fxScene_GetSnapshotInfo(scene, snapshot, &info))
        for (group = 0; group < info.groupsNewer; ++group) {
            const float* y = column(scene, snapshot, group, "y", &count);
            const float* radius = column(scene, snapshot, group, "radius", &count); /* 0: the row is empty */
            for (i = 0; y && radius && i < count; ++i)
                if (radius[i] > 0.0f) {
                    height += y[i];
                    ++particles;
                }
        }
    fxScene_ReleaseSnapshot(scene, snapshot);
    printf("frame %d: %u particles, mean height %.2f m\n", frame, particles,
           particles > 0 ? height / particles : 0.0);
    fflush(stdout);
}

static int fail(const char* message)
{
    fprintf(stderr, "%s\n", message);
    return 1;
}

int main(int argumentCount, char** arguments)
{
    const struct timespec frameTime = {0, 16666667};
    FxContextDef contextDef = fxDefaultContextDef();
    FxSceneDef sceneDef = fxDefaultSceneDef();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    FxLiveLinkDef linkDef = fxDefaultLiveLinkDef(); /* link */
    FxLiveLink* link = NULL;                        /* link */
    FxContext* context = NULL;
    FxScene* scene = NULL;
    FxInstanceId instance;
    Options options;
    int frame;
    if (!readOptions(argumentCount, arguments, &options))
        return fail("usage: 04_live_link PRESET [--link NAME] [--frames N]");
    if (fxCreateContext(&contextDef, &context) ||
        fxLoadPresetFile(context, options.preset, &instanceDef.preset) ||
        fxCreateScene(context, &sceneDef, &scene) || fxScene_CreateInstance(scene, &instanceDef, &instance))
        return fail(fxGetLastErrorMessage());
    linkDef.name = options.link;                                    /* link */
    if (options.link && fxCreateLiveLink(context, &linkDef, &link)) /* link */
        return fail(fxGetLiveLinkErrorMessage());
    for (frame = 0; options.frames == 0 || frame < options.frames; ++frame) {
        if (link && fxLiveLink_Update(link, &scene, 1)) /* link */
            return fail(fxGetLiveLinkErrorMessage());
        if (fxScene_Update(scene, 1.0 / 60.0))
            return fail(fxGetLastErrorMessage());
        if (frame % 60 == 59)
            printParticles(scene, frame + 1);
        nanosleep(&frameTime, NULL);
    }
    fxDestroyLiveLink(link); /* link */
    fxDestroyContext(context);
    return 0;
}
