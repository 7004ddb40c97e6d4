"""How well surfaces that touch pass heat on."""

ON_CERAMIC = 115.0
"""From a ceramic plate into a glass vessel that stands on it [W/m^2 K]; ours: 0.2 mm of air, as the
bottom of a beaker is a little hollow (0.030 W/m K, Incropera, table A.4), then 2.5 mm of glass
(1.2 W/m K, Schott Duran data sheet)."""
IN_WATER = 300.0
"""From a bath to the outside of a vessel in it [W/m^2 K]; free convection of water, as inside."""
IN_ICE = 150.0
"""From crushed ice with melt water to a vessel in it [W/m^2 K]; ours: half of it touches water."""
IN_BORE = 60.0
"""From a bore of a metal block to a tube in it [W/m^2 K]; ours: 0.5 mm of air (Incropera)."""
IN_AIR = 10.0
"""From the air and the walls of a chamber to what is in it [W/m^2 K]: 5 of free convection and 5 of
radiation near 300 K; a fan or a furnace gives more."""
