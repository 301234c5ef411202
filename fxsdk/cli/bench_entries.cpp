#include "fxsdk/cli/bench_entry.h"

#include "fxsdk/cli/bench_rows.h"

#include <array>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 3> kParticleVariants{"lean", "typical", "heavy"};
constexpr std::array<std::string_view, 2> kManySmallVariants{"many", "few"};
constexpr std::array<std::string_view, 7> kSortVariants{
    "random", "same", "hundredth-moved", "all-nearer", "nearer-and-moved", "radix", "standard"};
constexpr std::array<std::string_view, 3> kEmitVariants{"point", "sphere", "cone"};
constexpr std::array<std::string_view, 2> kFrameVariants{"unsorted", "sorted"};

constexpr std::array<BenchEntry, 5> kEntries{{
    {"particles", "One emitter: step it, publish the snapshot", kParticleVariants, true, true, false, 40'000,
     50'000'000, "particles", benchParticles},
    {"many-small", "The same number of particles in many small effects and in few", kManySmallVariants, true,
     false, true, 10'000, uint64_t(1) << 32, "particles", benchManySmall},
    {"sort", "The order of drawing, on one thread", kSortVariants, false, false, false, 400'000, 100'000'000,
     "elements", benchSort},
    {"emit", "Births: all particles are new in every step", kEmitVariants, true, false, false, 40'000,
     10'000'000, "births a step", benchEmit},
    {"frame", "Update, upload, submission and drawing of sprites with OpenGL", kFrameVariants, false, true,
     false, 20'000, 16'000'000, "sprites", benchFrame},
}};

std::string hexadecimal(uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace

std::span<const BenchEntry> benchEntries()
{
    return kEntries;
}

const BenchEntry* findBenchEntry(std::string_view name)
{
    for (const BenchEntry& entry : kEntries)
        if (entry.name == name)
            return &entry;
    return nullptr;
}

base::Result<std::vector<BenchRow>> measureVariants(const BenchEntry& entry, const BenchSettings& asked)
{
    BenchSettings settings = asked;
    if (settings.count == 0)
        settings.count = entry.usualCount;
    if (settings.count > entry.mostCount)
        return base::Status{base::Code::InvalidArgument,
                            "--count: at most " + std::to_string(entry.mostCount) + " " +
                                std::string(entry.elements) + " can be measured"};
    std::vector<BenchRow> rows;
    for (const std::string_view variant : entry.variants) {
        if (!settings.variant.empty() && settings.variant != variant)
            continue;
        base::Result<BenchRow> row = entry.measure(settings, variant);
        if (!row)
            return row.status();
        row->name = entry.name;
        row->variant = variant;
        row->count = settings.count;
        rows.push_back(std::move(*row));
    }
    return rows;
}

nlohmann::json toJson(const BenchRow& row)
{
    nlohmann::json json = row.more.is_object() ? row.more : nlohmann::json::object();
    json["name"] = row.name;
    json["variant"] = row.variant;
    json["count"] = row.count;
    json["ns_per_particle_median"] = row.medianNanoseconds;
    json["ns_per_particle_p95"] = row.p95Nanoseconds;
    json["bytes_per_particle"] = row.bytesPerParticle;
    json["bandwidth_fraction"] = row.bandwidthFraction;
    json["hash"] = hexadecimal(row.hash);
    return json;
}

std::string toText(const BenchRow& row)
{
    char text[256];
    std::snprintf(text, sizeof text, "%-10s %-15s %9llu particles  %8.3f ns (95 %%: %8.3f)", row.name.c_str(),
                  row.variant.c_str(), static_cast<unsigned long long>(row.count), row.medianNanoseconds,
                  row.p95Nanoseconds);
    std::string line = text;
    if (row.bytesPerParticle > 0) {
        std::snprintf(text, sizeof text, "  %5.1f bytes", row.bytesPerParticle);
        line += text;
    }
    if (row.bandwidthFraction > 0) {
        std::snprintf(text, sizeof text, "  %4.0f %% of a copy of as much", 100.0 * row.bandwidthFraction);
        line += text;
    }
    for (const char* part : {"ms_update", "ms_upload", "ms_submit", "ms_finish"})
        if (row.more.contains(part)) {
            std::snprintf(text, sizeof text, "  %s %.3f", part, row.more[part].get<double>());
            line += text;
        }
    return row.hash != 0 ? line + "  " + hexadecimal(row.hash) : line;
}

} // namespace fx::cli
