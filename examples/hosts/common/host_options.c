#define _POSIX_C_SOURCE 200112L /* clock_gettime */
#include "host_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int hostParse(int argumentCount, char** arguments, HostOptions* outOptions)
{
    const HostOptions defaults = {NULL, 0, 960, 540, 0};
    int isRight = 1;
    char rest;
    *outOptions = defaults;
    for (int i = 1; i < argumentCount && isRight; ++i) {
        const char* value = i + 1 < argumentCount ? arguments[i + 1] : "";
        if (strcmp(arguments[i], "--host-restores") == 0) {
            outOptions->hostRestores = 1;
            continue;
        }
        if (strcmp(arguments[i], "--headless") == 0 && *value)
            outOptions->output = value;
        else if (strcmp(arguments[i], "--frames") == 0)
            isRight = sscanf(value, "%d%c", &outOptions->frames, &rest) == 1 && outOptions->frames >= 1;
        else if (strcmp(arguments[i], "--size") == 0)
            isRight = sscanf(value, "%dx%d%c", &outOptions->width, &outOptions->height, &rest) == 2;
        else
            isRight = 0;
        ++i;
    }
    if (outOptions->output && outOptions->frames == 0)
        outOptions->frames = 95;
    isRight = isRight && outOptions->frames <= 100000 && outOptions->width >= 16 &&
              outOptions->width <= 4096 && outOptions->height >= 16 && outOptions->height <= 4096;
    if (!isRight)
        fprintf(stderr,
                "usage: %s [--headless FILE.png] [--frames 1..100000] [--size WxH, each 16..4096] "
                "[--host-restores]\n",
                arguments[0]);
    return isRight;
}

int hostDraws(const HostOptions* options, int frame)
{
    return !options->output || frame + 4 >= options->frames;
}

int hostPlays(const HostOptions* options, int frame)
{
    return options->frames == 0 || frame < options->frames;
}

double hostStep(const HostOptions* options)
{
    static struct timespec before;
    static int hasBefore = 0;
    const double longest = 0.1;
    struct timespec now;
    double seconds = 0.0;
    if (options->output)
        return 1.0 / 60.0;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (hasBefore)
        seconds = (double)(now.tv_sec - before.tv_sec) + 1e-9 * (double)(now.tv_nsec - before.tv_nsec);
    before = now;
    hasBefore = 1;
    return seconds < longest ? seconds : longest;
}
