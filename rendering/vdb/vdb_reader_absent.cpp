#include "rendering/vdb/vdb_reader.h"
#include "rendering/vdb/vdb_volume.h"

namespace fx::render {

base::Result<MediumGrid> readVdb(const std::string&, const VdbReadOptions&)
{
    return checkVdb();
}

} // namespace fx::render
