// SPDX-License-Identifier: MIT
// kaustik_reader: the process in which the libraries read what came from somewhere else
// (framework/reading/reader_process.h).
#include <cstdlib>

#include "framework/importers/answer_request.h"
#include "framework/reading/service.h"

#ifdef __SANITIZE_ADDRESS__
// As in the program: what libraries keep is theirs.
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}
#endif

int main(int argc, char** argv) {
    // A pool of threads, one a core, would take address space for nothing.
    ::setenv("OPENIMAGEIO_THREADS", "1", 0);
    return kaustik::reading::serve(argc, argv, kaustik::scene::answerRequest);
}
