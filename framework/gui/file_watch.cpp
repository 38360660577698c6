// SPDX-License-Identifier: MIT
#include "framework/gui/file_watch.h"

#include <system_error>

namespace kaustik::gui {

FileWatch::Times FileWatch::look() const {
    namespace fs = std::filesystem;
    Times times;
    std::error_code error;
    for (const fs::path& folder : folders_) {
        // A folder that cannot be read now, because an editor is at work in it, say, has no files.
        for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
             it.increment(error)) {
            std::error_code ofFile;
            const auto time = it->last_write_time(ofFile);
            if (!ofFile && it->is_regular_file(ofFile)) times.emplace(it->path().string(), time);
        }
    }
    return times;
}

bool FileWatch::hasChanged() {
    Times now = look();
    if (now == known_) return false;
    known_ = std::move(now);
    return true;
}

}  // namespace kaustik::gui
