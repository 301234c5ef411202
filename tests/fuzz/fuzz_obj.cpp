// Wavefront OBJ: meshes of particles (fx_assets), and meshes of stages with their materials (fx_scene_file).
#include "fxsdk/assets/obj_reader.h"
#include "fxsdk/scene_file/mesh_reader.h"
#include "tests/fuzz/fuzz_target.h"

#include <algorithm>
#include <cmath>

namespace fx::fuzz {

namespace {

/// Separates the mesh from its material file in an input.
constexpr std::string_view kMaterials = "\n#mtl\n";

struct Files
{
    std::string_view mesh, materials;
};

int readFiles(void* user, const char* name, uint64_t maxBytes, void (*deliver)(void*, const void*, size_t),
              void* sink)
{
    const Files& files = *static_cast<const Files*>(user);
    const std::string_view wanted = std::string_view(name) == "a.obj" ? files.mesh : files.materials;
    if (wanted.size() > maxBytes)
        return 2;
    deliver(sink, wanted.data(), wanted.size());
    return 0;
}

void checkParticleMesh(std::string_view text)
{
    const auto mesh = asset::readObj(text);
    if (!mesh) {
        require(!mesh.status().message().empty(), "a refused mesh has a message");
        return;
    }
    require(mesh->indices.size() % 3 == 0 && mesh->indices.size() / 3 <= asset::kMaxMeshTriangles,
            "a mesh consists of at most 65536 triangles");
    const auto isInside = [&](uint32_t index) { return index < mesh->vertices.size(); };
    require(std::all_of(mesh->indices.begin(), mesh->indices.end(), isInside), "indices name vertices");
    for (const base::MeshVertex& vertex : mesh->vertices)
        require(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z),
                "positions are finite");
}

void checkStageMesh(Files files)
{
    const asset::AssetResolver resolver("", {}, {&files, &readFiles});
    std::string warning;
    const auto mesh = scene_file::readMesh("a.obj", resolver, warning);
    if (!mesh)
        require(!mesh.status().message().empty(), "a refused stage mesh has a message");
}

} // namespace

void runInput(std::span<const uint8_t> input)
{
    const std::string_view text = textOf(input);
    const size_t cut = text.find(kMaterials);
    Files files{text.substr(0, cut), {}};
    if (cut != std::string_view::npos)
        files.materials = text.substr(cut + kMaterials.size());
    checkParticleMesh(files.mesh);
    checkStageMesh(files);
}

std::vector<std::string> seeds()
{
    return {
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n",
        "# a pyramid\no p\ng sides\ns 1\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5e0 0\n"
        "f 1 2 3 4\nf -5//  2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nl 1 2 3\np 1\n",
        "mtllib a.mtl\nv 0 0 0 1 0.5 0.5 0.5\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nusemtl red\nf 1 2 3 4 5\n"
        "#mtl\nnewmtl red\nKa 0 0 0\nKd 0.8 0.1 0.1\nKs 0 0 0\nNs 10\nd 1\nTr 0\nillum 2\nmap_Kd -s 1 1 1 "
        "a.png\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
        "v nan 0 0\nv inf 0 0\nv 1e39 1e-46 0\nf 1 2 3\n",
        "vt 0\nvn 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/1/1 3/1/1\ncurv 0 1 1 2\nf 1 1 1\n",
    };
}

} // namespace fx::fuzz
