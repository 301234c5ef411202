/// @file technique_rows.h
/// Table of techniques, with the objects in a frame that only one technique causes. A new technique needs an
/// entry in this table.
#pragma once

#include "tests/api/gl_ledger.h"

#include <set>
#include <string>
#include <vector>

namespace fx::test {

struct TechniqueRow
{
    std::string name;
    /// Members of a preset that use the technique; empty: a setting of the view enables the technique.
    std::string members;
    std::string standsOn;            ///< name of another technique that is required for drawing; empty: none
    std::vector<std::string> passes; ///< names of the passes of a frame right after a step
    std::set<std::string> programs;
    GlLedger::Counts textures, buffers;
    /// Passes and programs that occur only in this entry and in entries that require its technique.
    std::set<std::string> ownPasses, ownPrograms;
    /// True if the effect collides with the host's geometry, which the test then sets.
    bool meetsMesh = false;
};

/// Members of a preset with an emitter of 60 particles per second at the origin. @param more further members
/// of the emitter
inline std::string emitterMembers(const std::string& more)
{
    return R"("emitters": [{"shape": "sphere", "size": 0.4, "emission": {"rate": 60}, "lifetime": 1, "speed": 1,
        "radius": 0.3, "forces": {"gravity": 0}, )" +
           more + "}]";
}

inline TechniqueRow billboardRow(const std::string& name, const std::string& members,
                                 const std::string& standsOn)
{
    return {name,
            members,
            standsOn,
            {"scene distance", "blob upload", "media", "composite"},
            {"composite (blend)", "media"},
            {{"R32F", 1}, {"RGBA32F", 1}},
            {{"blobs", 1}, {"uniform ring", 1}},
            {},
            {}};
}

inline TechniqueRow shimmerRow()
{
    return {"heat shimmer",
            emitterMembers(R"("temperature": 1700, "heat": 1)"),
            "billboard layers",
            {"scene distance", "blob upload", "media", "composite", "heat offset", "heat shimmer",
             "heat shimmer back", "present"},
            {"composite", "heat offset", "heat shimmer", "heat shimmer back", "media", "present"},
            {{"R32F", 1}, {"RGBA32F", 3}},
            {{"blobs", 1}, {"frame buffer", 1}, {"uniform ring", 1}},
            {"heat offset", "heat shimmer", "heat shimmer back"},
            {"heat offset", "heat shimmer", "heat shimmer back"}};
}

inline TechniqueRow trailsRow()
{
    return {"trails",
            emitterMembers(R"("appearance": {"kind": "none"}, "trail": {"lifetime": 0.5})"),
            "",
            {"scene distance", "media", "composite"},
            {"composite (blend)", "ribbons"},
            {{"R32F", 1}, {"RGBA32F", 1}, {"RGBA8 array", 1}},
            {{"particle rows", 3}, {"uniform ring", 1}},
            {},
            {"ribbons"}};
}

inline TechniqueRow spritesRow()
{
    return {"sprites",
            emitterMembers(R"("appearance": {"kind": "sprite"})"),
            "",
            {"scene distance", "media", "composite"},
            {"composite (blend)", "sprites"},
            {{"R32F", 1}, {"RGBA32F", 1}, {"RGBA8 array", 1}},
            {{"particle orders", 3}, {"particle rows", 3}, {"uniform ring", 1}},
            {},
            {"sprites"}};
}

inline TechniqueRow meshesRow()
{
    return {"mesh particles",
            emitterMembers(
                R"("appearance": {"kind": "mesh", "mesh": "library:debris-chunk.obj", "blend": "opaque"})"),
            "",
            {"scene distance", "solid particles", "composite"},
            {"composite (blend)", "particle meshes"},
            {{"Depth32F", 1}, {"R32F", 2}, {"RGBA32F", 1}, {"RGBA8 array", 1}},
            {{"particle mesh", 1}, {"particle rows", 3}, {"uniform ring", 1}},
            {"solid particles"},
            {"particle meshes"}};
}

inline TechniqueRow lightsRow() ///< entry for lights that are listed for the host, and not drawn
{
    return {"particle lights",
            emitterMembers(R"("appearance": {"kind": "none"}, "light": {"intensity": 10})"),
            "",
            {},
            {},
            {},
            {},
            {},
            {}};
}

/// Entry for the host's geometry, with which effects collide. The geometry is not drawn.
inline TechniqueRow sceneMeshRow()
{
    TechniqueRow row{"scene mesh",
                     emitterMembers(R"("appearance": {"kind": "none"}, "collisions": [{"shape": "scene"}])"),
                     "",
                     {},
                     {},
                     {},
                     {},
                     {},
                     {}};
    row.meetsMesh = true;
    return row;
}

/// Entry for sprites that the GPU simulates and sorts.
inline TechniqueRow gpuParticlesRow()
{
    return {
        "gpu particles",
        emitterMembers(
            R"("compute": "gpu", "maxParticles": 100, "appearance": {"kind": "sprite", "order": "depth"})"),
        "sprites",
        {"scene distance", "gpu particles", "gpu particle order", "media", "composite"},
        {"composite (blend)", "gpu particle order", "gpu particles", "sprites"},
        {{"R32F", 1}, {"RGBA32F", 1}, {"RGBA8 array", 1}},
        {{"computed particle rows", 3},
         {"frame buffer", 3},
         {"gpu particle numbers", 1},
         {"particle rows", 3},
         {"uniform ring", 1}},
        {"gpu particles", "gpu particle order"},
        {"gpu particles", "gpu particle order"}};
}

inline TechniqueRow dazzleRow()
{
    return {"dazzle",
            "",
            "",
            {"dazzle sum", "dazzle budget", "dazzle deal", "present"},
            {"dazzle budget", "dazzle deal", "dazzle sum", "present"},
            {{"RGBA32F", 1}},
            {{"dazzle history", 1}, {"frame buffer", 2}, {"uniform ring", 1}},
            {"dazzle sum", "dazzle budget", "dazzle deal"},
            {"dazzle budget", "dazzle deal", "dazzle sum"}};
}

inline std::vector<TechniqueRow> techniqueRows()
{
    TechniqueRow billboards = billboardRow(
        "billboard layers", emitterMembers(R"("layer": "dust", "albedoOverLife": [0.5, 0.5, 0.5])"), "");
    billboards.ownPasses = {"blob upload"};
    billboards.ownPrograms = {"media"};
    std::vector<TechniqueRow> rows{billboards,  shimmerRow(), trailsRow(),    spritesRow(),
                                   meshesRow(), lightsRow(),  sceneMeshRow(), dazzleRow()};
#if FXSDK_WITH_SPH
    rows.push_back(billboardRow("sph gas", R"("gas": [{"particles": 40, "heat": 0, "detailAmount": 0}])",
                                "billboard layers"));
#endif
#if FXSDK_WITH_GPU_PARTICLES
    rows.push_back(gpuParticlesRow());
#endif
    return rows;
}

} // namespace fx::test
