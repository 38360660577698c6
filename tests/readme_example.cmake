# SPDX-License-Identifier: MIT
# The README's example technique as files, so that what is tested is what is read there: each block
# of code in "Add a technique" that begins with "// PATH" becomes FOLDER/PATH.
function(kaustik_readme_example folder)
    set(readme ${CMAKE_SOURCE_DIR}/README.md)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${readme})
    file(READ ${readme} rest)
    string(FIND "${rest}" "\n## Add a technique\n" begin)
    string(FIND "${rest}" "\n## Build by hand\n" end)
    math(EXPR length "${end} - ${begin}")
    string(SUBSTRING "${rest}" ${begin} ${length} rest)
    foreach(path ${ARGN})
        string(FIND "${rest}" "\n// ${path}\n" begin)
        if(begin EQUAL -1)
            message(FATAL_ERROR "README.md, \"Add a technique\": no block begins with \"// ${path}\".")
        endif()
        string(SUBSTRING "${rest}" ${begin} -1 block)
        string(FIND "${block}" "\n```\n" end)
        string(SUBSTRING "${block}" 1 ${end} block)
        # Only written where it differs, so that nothing is compiled in vain.
        file(CONFIGURE OUTPUT ${folder}/${path} CONTENT "${block}" @ONLY)
    endforeach()
endfunction()
