#include "fxsdk/assets/obj_reader.h"

#include "foundation/math/bits.h"

#include <glm/geometric.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string>

namespace fx::asset {

namespace {

template <class T>
std::errc parse(std::string_view word, T& out)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-')
        word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc() && end != word.data() + word.size() ? std::errc::invalid_argument : error;
}

class LineReader
{
public:
    explicit LineReader(const ObjHandler& handler) : handler_(handler) {}

    base::Result<ObjPoints> read(std::string_view text)
    {
        for (size_t begin = 0; begin < text.size(); ++line_) {
            const size_t end = std::min(text.find('\n', begin), text.size());
            if (base::Status status = readLine(text.substr(begin, end - begin)); !status)
                return status;
            begin = end + 1;
        }
        return std::move(points_);
    }

private:
    base::Status fault(const std::string& why) const
    {
        return {base::Code::Parse, "line " + std::to_string(line_) + ": " + why};
    }

    base::Status readLine(std::string_view rest)
    {
        const std::string_view kind = takeWord(rest);
        if (kind == "v")
            return readNumbers(kind, rest, 3, points_.positions);
        if (kind == "vn" && handler_.wantsNormals)
            return readNumbers(kind, rest, 3, points_.normals);
        if (kind == "vt" && handler_.wantsTextures)
            return readNumbers(kind, rest, 2, points_.textures);
        if (kind == "f")
            return readFace(rest);
        if (kind == "usemtl" && handler_.material)
            handler_.material(takeWord(rest));
        if (kind == "mtllib" && handler_.materialFiles)
            handler_.materialFiles(rest);
        return {};
    }

    template <class V>
    base::Status readNumbers(std::string_view kind, std::string_view rest, int count, std::vector<V>& out)
    {
        V v(0.0f);
        for (int i = 0; i < count; ++i)
            if (!parseFloat(takeWord(rest), v[i]))
                return fault(std::to_string(count) + " finite numbers must follow " + std::string(kind));
        out.push_back(v);
        return {};
    }

    base::Status readFace(std::string_view rest)
    {
        corners_.clear();
        for (std::string_view word = takeWord(rest); !word.empty() && word[0] != '#'; word = takeWord(rest)) {
            ObjCorner corner{-1};
            if (!readCorner(word, corner))
                return fault("\"" + std::string(word.substr(0, 40)) +
                             "\" names nothing that was read before");
            corners_.push_back(corner);
        }
        if (corners_.size() < 3)
            return fault("a face needs three corners");
        if (!handler_.face)
            return {};
        base::Status status = handler_.face(points_, corners_);
        return status || status.code() != base::Code::Parse ? status : fault(status.message());
    }

    /// "7", "7/2", "7//3" or "7/2/3"; negative numbers count from the last one read.
    bool readCorner(std::string_view word, ObjCorner& out) const
    {
        std::array<std::string_view, 3> parts; // position, texture, normal
        for (std::string_view& part : parts) {
            part = word.substr(0, word.find('/'));
            word.remove_prefix(std::min(part.size() + 1, word.size()));
        }
        return readIndex(parts[0], points_.positions.size(), out.position) &&
               (!handler_.wantsTextures || readIndex(parts[1], points_.textures.size(), out.texture)) &&
               (!handler_.wantsNormals || readIndex(parts[2], points_.normals.size(), out.normal)) &&
               out.position >= 0;
    }

    /// An empty part leaves `out` as it is.
    static bool readIndex(std::string_view part, size_t count, int64_t& out)
    {
        if (part.empty())
            return true;
        int64_t number = 0;
        const auto size = int64_t(count);
        if (parse(part, number) != std::errc() || number == 0 || number > size || number < -size)
            return false;
        out = number > 0 ? number - 1 : size + number;
        return true;
    }

    const ObjHandler& handler_;
    ObjPoints points_;
    std::vector<ObjCorner> corners_;
    size_t line_ = 1;
};

class MeshBuilder
{
public:
    base::Status addFace(const ObjPoints& points, std::span<const ObjCorner> corners)
    {
        for (size_t i = 2; i < corners.size(); ++i)
            addTriangle(points, {corners[0], corners[i - 1], corners[i]});
        if (mesh_.indices.size() / 3 > kMaxMeshTriangles)
            return {base::Code::TooLarge, "more than the allowed " + std::to_string(kMaxMeshTriangles) +
                                              " triangles: use a coarser mesh"};
        return {};
    }
    ObjMesh take() { return std::move(mesh_); }

private:
    void addTriangle(const ObjPoints& points, const std::array<ObjCorner, 3>& corners)
    {
        const auto place = [&](size_t i) { return points.positions[size_t(corners[i].position)]; };
        const glm::vec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
        const float size = glm::length(across);
        const glm::vec3 face = size > 0.0f ? across / size : glm::vec3(0.0f, 1.0f, 0.0f);
        for (const ObjCorner& corner : corners)
            mesh_.indices.push_back(indexOf(points, corner, face));
    }

    uint32_t indexOf(const ObjPoints& points, const ObjCorner& corner, const glm::vec3& face)
    {
        if (corner.normal >= 0) {
            const auto found = known_.find(corner);
            if (found != known_.end())
                return found->second;
        }
        glm::vec3 normal = face;
        if (corner.normal >= 0 && glm::length(points.normals[size_t(corner.normal)]) > 0.0f)
            normal = glm::normalize(points.normals[size_t(corner.normal)]);
        const auto index = uint32_t(mesh_.vertices.size());
        mesh_.vertices.push_back(
            {points.positions[size_t(corner.position)], normal,
             corner.texture >= 0 ? points.textures[size_t(corner.texture)] : glm::vec2(0.0f)});
        if (corner.normal >= 0)
            known_.emplace(corner, index);
        return index;
    }

    ObjMesh mesh_;
    std::map<ObjCorner, uint32_t> known_;
};

} // namespace

std::string_view takeWord(std::string_view& io)
{
    const size_t begin = std::min(io.find_first_not_of(" \t\r"), io.size());
    const size_t end = std::min(io.find_first_of(" \t\r", begin), io.size());
    const std::string_view word = io.substr(begin, end - begin);
    io.remove_prefix(end);
    return word;
}

bool parseFloat(std::string_view word, float& out)
{
    std::errc error = parse(word, out);
    if (error == std::errc::result_out_of_range) {
        double exact = 0.0;
        error = parse(word, exact);
        out = float(exact); // an infinity where it is too large
    }
    return error == std::errc() && base::isFinite(double(out));
}

base::Result<ObjPoints> parseObj(std::string_view text, const ObjHandler& handler)
{
    return LineReader(handler).read(text);
}

base::Result<ObjMesh> readObj(std::string_view text)
{
    MeshBuilder builder;
    ObjHandler handler;
    handler.face = [&](const ObjPoints& points, std::span<const ObjCorner> corners) {
        return builder.addFace(points, corners);
    };
    if (const auto points = parseObj(text, handler); !points)
        return base::Status(points.status().code(), "OBJ: " + points.status().message());
    ObjMesh mesh = builder.take();
    if (mesh.indices.empty())
        return base::Status(base::Code::Parse, "OBJ: no triangle (no line begins with f)");
    return mesh;
}

base::Result<ObjTriangles> readObjTriangles(std::string_view text)
{
    ObjTriangles out;
    ObjHandler handler;
    handler.wantsTextures = handler.wantsNormals = false;
    handler.face = [&](const ObjPoints&, std::span<const ObjCorner> corners) -> base::Status {
        for (size_t i = 2; i < corners.size(); ++i)
            for (const size_t k : {size_t(0), i - 1, i})
                out.indices.push_back(uint32_t(corners[k].position));
        return {};
    };
    base::Result<ObjPoints> points = parseObj(text, handler);
    if (!points)
        return points.status();
    out.positions = std::move(points->positions);
    return out;
}

} // namespace fx::asset
