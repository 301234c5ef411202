#include "fxsdk/scene_file/scene_members.h"

#include "fxsdk/scene_file/mesh_reader.h"
#include "fxsdk/scene_file/stages.h"
#include "rendering/image/image.h"

#include <span>

namespace fx::scene_file {

using preset::Findings;
using preset::PresetValue;

namespace {

base::Result<image::Image> decodeImage(const std::string& name, const std::string& bytes)
{
    const auto data = std::as_bytes(std::span<const char>(bytes.data(), bytes.size()));
    return name.ends_with(".hdr") ? image::readHdr(data) : image::readPng(data);
}

} // namespace

void reportAsset(const PresetValue& value, const char* member, const base::Status& status, Findings& findings)
{
    findings.error(value.pointer() + "/" + member, status.message(), status.code());
}

base::Result<render::StageMesh> readMeshMember(const PresetValue& value, const asset::AssetResolver& resolver,
                                               Findings& findings)
{
    std::string name;
    value.read("file", name);
    std::string warning;
    base::Result<render::StageMesh> mesh = readMesh(name, resolver.withLibrary(libraryWithStages()), warning);
    if (!warning.empty())
        value.warning("file", warning);
    if (!mesh)
        reportAsset(value, "file", mesh.status(), findings);
    return mesh;
}

void readSceneMesh(const PresetValue& value, const asset::AssetResolver& resolver, Findings& findings,
                   SceneFile& scene)
{
    std::string name;
    value.read("file", name);
    if (name.empty())
        return;
    base::Result<render::StageMesh> mesh = readMeshMember(value, resolver, findings);
    if (!mesh)
        return;
    glm::vec3 position(0.0f);
    float scale = 1.0f;
    value.read("position", position);
    value.read("scale", scale);
    value.read("collide", scene.meshCollides);
    value.read("cellSize", scene.meshCellSize);
    if (value.has("cellSize") && !scene.meshCollides)
        value.warning("cellSize", "found a size of cells, but effects do not collide with the mesh; add "
                                  "\"collide\": true");
    for (glm::vec3& vertex : mesh->positions)
        vertex = position + scale * vertex;
    scene.mesh = std::move(*mesh);
    scene.meshFile = resolver.fileOf(name);
}

void readBackground(const PresetValue& value, const asset::AssetResolver& resolver, Findings& findings,
                    SceneFile& scene)
{
    render::StageBackground& background = scene.background;
    value.read("color", background.luminance);
    background.horizon = background.luminance;
    value.read("horizon", background.horizon);
    value.read("panorama", background.panorama);
    float luminance = 1000.0f;
    value.read("luminance", luminance);
    std::string name;
    value.read("image", name);
    if (name.empty())
        return;
    const base::Result<std::string> bytes = resolver.read(name, kImageBytes);
    if (!bytes)
        return reportAsset(value, "image", bytes.status(), findings);
    const base::Result<image::Image> picture = decodeImage(name, *bytes);
    if (!picture)
        return reportAsset(value, "image", picture.status(), findings);
    background.width = picture->width;
    background.height = picture->height;
    background.image.reserve(size_t(picture->width) * size_t(picture->height));
    for (int y = 0; y < picture->height; ++y)
        for (int x = 0; x < picture->width; ++x) {
            const float* rgb = picture->at(x, y);
            background.image.push_back(luminance * glm::vec3(rgb[0], rgb[1], rgb[2]));
        }
}

} // namespace fx::scene_file
