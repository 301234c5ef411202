#include "fxsdk/cli/render/blob_list_reader.h"

#include "fxsdk/assets/read_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace fx::cli {
namespace {

constexpr std::string_view kHeader = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kOptional = ",g"; ///< what the header may end with
constexpr size_t kColumns = 10;
constexpr double kLargest = 1e12;

/// What a column may hold.
struct Column
{
    std::string_view name;
    double low, high;
    bool isOpen; ///< `low` itself is not allowed
    std::string_view range;
};

constexpr std::array<Column, kColumns> kColumn{{
    {"x", -kLargest, kLargest, false, "a number from -1e12 to 1e12"},
    {"y", -kLargest, kLargest, false, "a number from -1e12 to 1e12"},
    {"z", -kLargest, kLargest, false, "a number from -1e12 to 1e12"},
    {"radius", 0.0, kLargest, true, "a number above 0, up to 1e12"},
    {"tau_area", 0.0, kLargest, false, "a number from 0 to 1e12"},
    {"albedo", 0.0, 1.0, false, "a number from 0 to 1"},
    {"er", 0.0, kLargest, false, "a number from 0 to 1e12"},
    {"eg", 0.0, kLargest, false, "a number from 0 to 1e12"},
    {"eb", 0.0, kLargest, false, "a number from 0 to 1e12"},
    {"g", -0.99, 0.99, false, "a number from -0.99 to 0.99"},
}};

using Row = std::array<double, kColumns>;

std::string_view withoutSpaces(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    return text;
}

/// The beginning of a field, escaped for messages: control codes of a file must not reach the terminal.
std::string printable(std::string_view field)
{
    std::string text(field.substr(0, 40));
    for (char& c : text)
        if (uint8_t(c) < 0x20 || c == 0x7F)
            c = '?';
    return text;
}

/// Reads the text line by line and keeps the position.
class BlobListReader
{
public:
    BlobListReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    base::Result<std::vector<render::MediumBlob>> read()
    {
        if (text_.starts_with(kByteOrderMark)) // spreadsheets write one
            text_.remove_prefix(kByteOrderMark.size());
        std::string_view line;
        const bool isThere = nextLine(line);
        std::string_view header = withoutSpaces(line);
        columns_ = header.ends_with(kOptional) ? kColumns : kColumns - 1;
        if (columns_ == kColumns)
            header.remove_suffix(kOptional.size());
        if (!isThere || header != kHeader)
            return failed(1, "the first line must be " + std::string(kHeader) + ", and may end with ,g");
        std::vector<render::MediumBlob> blobs;
        while (nextLine(line)) {
            if (withoutSpaces(line).empty())
                continue;
            Row row{};
            if (base::Status status = readRow(line, row); !status)
                return status;
            blobs.push_back(blobOf(row));
        }
        return blobs;
    }

private:
    bool nextLine(std::string_view& out)
    {
        if (at_ >= text_.size())
            return false;
        const size_t end = std::min(text_.find('\n', at_), text_.size());
        out = text_.substr(at_, end - at_);
        if (!out.empty() && out.back() == '\r')
            out.remove_suffix(1);
        at_ = end + 1;
        ++line_;
        return true;
    }

    base::Status failed(size_t column, const std::string& what) const
    {
        return {base::Code::Parse, name_ + ":" + std::to_string(std::max<size_t>(line_, 1)) + ":" +
                                       std::to_string(column) + ": " + what};
    }

    base::Status readRow(std::string_view line, Row& out) const
    {
        size_t at = 0;
        for (size_t c = 0; c < columns_; ++c) {
            const size_t end = std::min(line.find(',', at), line.size());
            if (c + 1 < columns_ && end == line.size())
                return failed(line.size() + 1, "expected " + std::to_string(columns_) + " numbers, found " +
                                                   std::to_string(c + 1));
            if (c + 1 == columns_ && end != line.size())
                return failed(end + 1,
                              "expected the end of the line after " + std::to_string(columns_) + " numbers");
            if (base::Status status = readNumber(line.substr(at, end - at), at + 1, kColumn[c], out[c]);
                !status)
                return status;
            at = end + 1;
        }
        return {};
    }

    base::Status readNumber(std::string_view field, size_t position, const Column& column, double& out) const
    {
        const std::string_view number = withoutSpaces(field);
        const char* const end = number.data() + number.size();
        const auto [rest, error] = std::from_chars(number.data(), end, out);
        const bool isNumber = error == std::errc() && rest == end && std::isfinite(out);
        if (isNumber && out >= column.low && out <= column.high && !(column.isOpen && out == column.low))
            return {};
        return failed(position, "found '" + printable(number) + "' for " + std::string(column.name) +
                                    ", expected " + std::string(column.range));
    }

    static render::MediumBlob blobOf(const Row& row)
    {
        render::MediumBlob blob;
        blob.center = {row[0], row[1], row[2]};
        blob.radius = row[3];
        blob.crossSection = row[4];
        blob.albedo = glm::dvec3(row[5]);
        blob.source = (1.0 - row[5]) * glm::dvec3(row[6], row[7], row[8]);
        blob.anisotropy = row[9];
        return blob;
    }

    std::string_view text_;
    const std::string& name_;
    size_t at_ = 0;
    size_t columns_ = kColumns; ///< of this list
    size_t line_ = 0;           ///< number of the line read last, from 1
};

} // namespace

base::Result<std::vector<render::MediumBlob>> readBlobList(std::string_view text, const std::string& name)
{
    return BlobListReader(text, name).read();
}

base::Result<std::vector<render::MediumBlob>> loadBlobList(const std::string& path)
{
    const auto text = asset::readFile(path, kBlobListBytes);
    if (!text.ok())
        return text.status();
    return readBlobList(*text, path);
}

} // namespace fx::cli
