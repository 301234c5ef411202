#include "benchmarks/stability/stability_picture.h"

#include <cctype>
#include <cstdint>

namespace fx::cli {
namespace {

struct Letter
{
    char sign;
    uint64_t bits; ///< seven rows of five from the top, the upper left in bit 34
};

constexpr Letter kLetters[] = {
    {'0', 0x3a33ae62e}, {'1', 0x11842108e}, {'2', 0x3a211111f}, {'3', 0x3a213062e}, {'4', 0x08ca97c42},
    {'5', 0x7e1e0862e}, {'6', 0x1910f462e}, {'7', 0x7c2221108}, {'8', 0x3a317462e}, {'9', 0x3a317844c},
    {'a', 0x000e0be2f}, {'b', 0x421e8c63e}, {'c', 0x000e8422e}, {'d', 0x042f8c62f}, {'e', 0x000e8fe0e},
    {'f', 0x1908f2108}, {'g', 0x000f8bc2e}, {'h', 0x421e8c631}, {'i', 0x100c2108e}, {'j', 0x080610a4c},
    {'k', 0x4212a6292}, {'l', 0x30842108e}, {'m', 0x001aad631}, {'n', 0x001e8c631}, {'o', 0x000e8c62e},
    {'p', 0x001e8fa10}, {'q', 0x000f8bc21}, {'r', 0x0016c4210}, {'s', 0x000f8383e}, {'t', 0x211e42106},
    {'u', 0x00118c62f}, {'v', 0x00118c544}, {'w', 0x00118d6aa}, {'x', 0x001151151}, {'y', 0x00118bc2e},
    {'z', 0x001f1111f}, {'.', 0x00000018c}, {',', 0x000003088}, {':', 0x018c03180}, {'-', 0x0000f8000},
    {'+', 0x0084f9080}, {'/', 0x002222200}, {'=', 0x001f07c00}, {'[', 0x39084210e}, {']', 0x38421084e},
    {'(', 0x088842082}, {')', 0x208210888}, {'^', 0x115100000},
};

uint64_t bitsOf(char sign)
{
    const char wanted = char(std::tolower(static_cast<unsigned char>(sign)));
    for (const Letter& letter : kLetters)
        if (letter.sign == wanted)
            return letter.bits;
    return 0;
}

void drawDot(image::Image& picture, int x, int y)
{
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height)
        return;
    float* pixel = picture.at(x, y);
    pixel[0] = pixel[1] = pixel[2] = 0.1f;
}

} // namespace

void drawText(image::Image& picture, int x, int y, const std::string& text, bool isUpwards)
{
    int at = 0;
    for (const char sign : text) {
        const uint64_t bits = bitsOf(sign);
        for (int row = 0; row < 7; ++row)
            for (int column = 0; column < 5; ++column)
                if (bits >> (34 - 5 * row - column) & 1) {
                    if (isUpwards)
                        drawDot(picture, x + row, y - at - column);
                    else
                        drawDot(picture, x + at + column, y + row);
                }
        at += 6;
    }
}

} // namespace fx::cli
