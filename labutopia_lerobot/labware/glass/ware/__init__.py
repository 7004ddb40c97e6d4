"""Tables of glass, porcelain and plastic ware, as in catalogues; `glass.series` reads them."""
