#include "fxsdk/cli/import/volume_import.h"

#include "rendering/vdb/vdb_volume.h"

namespace fx::cli {

base::Result<render::MediumGrid> importVolume(const std::string& path, const render::VdbReadOptions& options,
                                              const ChildLimits& limits, ChildReport* outReport)
{
    if (base::Status status = render::checkVdb(); !status)
        return status;
    ChildReport report;
    const auto bytes = runInChild(
        limits,
        [&](std::string& out) -> base::Status {
            const auto grid = render::readVdb(path, options);
            if (!grid)
                return grid.status();
            out = render::toBytes(*grid);
            return {};
        },
        &report);
    if (outReport)
        *outReport = report;
    if (!bytes) {
        const base::Status& status = bytes.status();
        const bool isOfChild = status.message().starts_with(path) || status.code() == base::Code::Interrupted;
        return isOfChild ? status
                         : base::Status(status.code(),
                                        path + ": reading it " + status.message() +
                                            (report.signal ? "; the file is damaged or too large" : ""));
    }
    auto grid = render::mediumGridFromBytes(*bytes);
    if (!grid)
        return base::Status(grid.status().code(), path + ": " + grid.status().message());
    return grid;
}

} // namespace fx::cli
