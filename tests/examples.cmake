# SPDX-License-Identifier: MIT
# Examples of documents and comments as files, so that what is tested is what is read there.

# Each block of code in DOCUMENT that begins with "// PATH" or "# PATH" becomes FOLDER/PATH.
function(kaustik_document_example folder document)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${document})
    file(READ ${document} text)
    foreach(path ${ARGN})
        string(FIND "${text}" "\n// ${path}\n" begin)
        if(begin EQUAL -1)
            string(FIND "${text}" "\n# ${path}\n" begin)
        endif()
        if(begin EQUAL -1)
            message(FATAL_ERROR "${document}: no block begins with \"${path}\".")
        endif()
        string(SUBSTRING "${text}" ${begin} -1 block)
        string(FIND "${block}" "\n```\n" end)
        string(SUBSTRING "${block}" 1 ${end} block)
        # Only written where it differs, so that nothing is compiled in vain.
        file(CONFIGURE OUTPUT ${folder}/${path} CONTENT "${block}" @ONLY)
    endforeach()
endfunction()

# The first lines of the comment at the head of HEADER that are code, indented by four, become FILE.
function(kaustik_comment_example file header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
    file(READ ${header} text)
    string(FIND "${text}" "\n//\n//     " begin)
    if(begin EQUAL -1)
        message(FATAL_ERROR "${header}: the comment at its head has no example.")
    endif()
    string(SUBSTRING "${text}" ${begin} -1 text)
    string(REGEX MATCH "^(\n//     [^\n]*|\n//)+" block "${text}")
    string(REGEX REPLACE "\n//     |\n//" "\n" block "${block}")
    file(CONFIGURE OUTPUT ${file} CONTENT "${block}" @ONLY)
endfunction()
