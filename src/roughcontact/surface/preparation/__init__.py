"""From a measured surface to one that is analysed or pressed."""
