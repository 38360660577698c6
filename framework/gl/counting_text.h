// SPDX-License-Identifier: MIT
// Changes the text of a shader so that it also counts what it reads and writes: every texel that it
// fetches, loads or stores, every element of a storage block, every atomic and every pixel that it
// draws. Of memory it notes which texels and
// which pieces of buffers were touched, in a bit each, and how many bytes were asked
// for in all. What it computes stays as it was. No OpenGL here: the layout of storage blocks is
// given. gl::AccessCounter runs such shaders.
//
// What is taken for granted: samplers, images and members of storage blocks are used by their own
// names, as all of the project's shaders do (functions take none of them as parameters). Uniforms
// and members of blocks that are no arrays are left out: a device holds those few bytes near.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace kaustik::gl {

// A variable of a storage block as the driver lays it out ("bvhNodes[0].lower"), bytes.
struct BlockVariable {
    std::string block;
    int offset = 0;          // in the block, of the first element of every array around it
    int bytes = 0;           // of one element
    int elements = 1;        // of it; 0 where the block's end decides
    int stride = 0;          // of those
    int topLevelStride = 0;  // of the outermost array, 0 where the variable is in none
};
using BlockLayout = std::map<std::string, BlockVariable>;

enum class CountingStage { vertex, geometry, fragment, compute };

// What a shader accesses has a number; these are those of what has no name there.
inline constexpr int kCountedNames = 48;    // numbers that named things may have
inline constexpr int kCountedTargets = 48;  // colours that are drawn to, eight numbers
inline constexpr int kCountedDepth = 56;
inline constexpr int kCountedVertices = 57;
inline constexpr int kCountedNumbers = 64;
// Of buffers, the bytes that a bit stands for; of textures it is a texel.
inline constexpr int kCountedPiece = 16;
// The sums of all threads are kept in so many parts, of four words each: bytes that were asked for
// to read and to write, atomics, threads.
inline constexpr int kCountedShards = 1024;

// `names`: what has a number so far, by number; new ones are appended, so that the stages of a
// program share them. Throws ShaderError where there are too many.
[[nodiscard]] std::string countingText(const std::string& text, CountingStage stage,
                                       const BlockLayout& layout, std::vector<std::string>& names);

}  // namespace kaustik::gl
