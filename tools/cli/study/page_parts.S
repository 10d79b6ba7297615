/* The page's parts as they are in their files, each between two symbols. */
        .section .rodata
        .macro part name, file
        .global firn_page_\name
        .global firn_page_\name\()_end
firn_page_\name:
        .incbin "\file"
firn_page_\name\()_end:
        .endm

        part html, FIRN_PAGE_HTML
        part style, FIRN_PAGE_STYLE
        part script, FIRN_PAGE_SCRIPT
        part chart, FIRN_PAGE_CHART

        .section .note.GNU-stack, "", %progbits
