#include "benchmarks/bench/bench_row.h"

#include <cstdio>

namespace fx::cli {
namespace {

std::string hexadecimal(uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace

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
