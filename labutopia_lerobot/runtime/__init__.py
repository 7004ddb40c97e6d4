"""The machinery below the programs: worker processes, videos."""
