"""Which words are names of chemicals, though no compound here may have them.

Nomenclature builds words of parts (IUPAC, "Nomenclature of Organic Chemistry", 2013, and
"Nomenclature of Inorganic Chemistry", 2005). The lists of parts are ours.
"""

from functools import cache

_ELEMENTS = """
hydrogen helium lithium beryllium boron carbon nitrogen oxygen fluorine neon sodium magnesium
aluminum silicon phosphorus sulfur chlorine argon potassium calcium scandium titanium vanadium
chromium manganese iron cobalt nickel copper zinc gallium germanium arsenic selenium bromine krypton
rubidium strontium yttrium zirconium niobium molybdenum technetium ruthenium rhodium palladium
silver cadmium indium tin antimony tellurium iodine xenon cesium barium lanthanum cerium
praseodymium neodymium promethium samarium europium gadolinium terbium dysprosium holmium erbium
thulium ytterbium lutetium hafnium tantalum tungsten rhenium osmium iridium platinum gold mercury
thallium lead bismuth polonium astatine radon francium radium actinium thorium protactinium uranium
neptunium plutonium americium ammonium phosphonium sulfonium
"""
_COUNTS = """
mono di bi tri tetra penta hexa hepta octa nona deca undeca dodeca hemi sesqui per hypo poly bis
tris tetrakis cyclo iso neo sec tert ortho meta para pyro cis trans endo exo super sub
"""
_STEMS = """
meth eth prop but pent hex hept oct non dec undec dodec tridec tetradec hexadec octadec eicos cet am
all vin benz benzo phen tolu xyl cumen mesityl naphth naphthal anthr anthrac phenanthr pyr pyrr fur
furfur thi thio styr anil anis cres quin quinol indol glyc lact malon succin male fumar tart tartar
citr oxal form acet propion butyr isobutyr valer capro capr capryl laur myrist palmit stear ole
linole linolen arachid salicyl phthal terephthal isophthal cinnam vanill pic picr gall tann ascorb
gluc fruct galact mann rib arabin xylul sucr malt cellul trehal lev sorb mannit xylit alan valin
leuc isoleuc ser threon cyste cyst methion asparag aspart glutam glutamin lys argin histid tyros
tryptoph prol ure uracil thym cytos aden guan caff theobrom nicot adip pimel suber sebac glut
glutar glyox pyruv acryl crot crotyl morphol piper pyrid pyrimid hydraz hydroxyl fulmin azid
fluor chlor brom iod astat sulf sulfon sulfin sel selen tellur nitr phosph phosphor arsen antimon
stib bor carb carbon silic cyan germ stann plumb cupr argent aur ferr mercur chrom mangan cobalt
nickel vanad niob molybd tungst wolfram titan zircon alumin beryll zinc bismuth plat palladi rhen
osm uran thall hydr hydro oxy oxo ox peroxo perox peroxy azo diazo imin imid sil
"""
_GROUPS = """
chloro bromo iodo fluoro nitro nitroso amino hydroxy methoxy ethoxy propoxy butoxy phenoxy cyano
thiocyanato cyanato isocyanato acetyl acetoxy benzoyl benzyl carboxy keto sulfo mercapto imino
hydrazino ammine aqua chlorido cyanido hydroxido oxalato nitrito sulfato benzene toluene phenol
ether ester acid
"""
_ENDINGS = """
ane ene yne an en yn ol al one diol triol dione dial thiol dioic dioate oic oate oyl yl ylene
idene amine amide imide imine nitrile ose ulose ide ate ite ic ous ine in ium onium hydride
hydroxide oxide peroxide sulfide anhydride hydrate carbonate hydrogen idine azine azole ole ano anol
anal anone anoic eno onic uric aric itol ane inic onate inate ous
"""
_PARTS = frozenset(" ".join((_ELEMENTS, _COUNTS, _STEMS, _GROUPS, _ENDINGS)).split())
_LONGEST = max(map(len, _PARTS))


_SERIES = (
    (
        "meth eth prop but pent hex hept oct non dec",
        "ane ene yne anol anal anone anoic anoate yl oxy ylamine anamine ylene oxide anediol anoyl",
    ),
    (
        "sulf chlor brom iod nitr phosph fluor selen tellur arsen cyan chrom perchlor perbrom "
        "period hypochlor hypobrom hypoiod thiosulf thiocyan bisulf silic bor carb azid antimon "
        "bismuth vanad molybd tungst alumin stann plumb zinc ferr titan zircon",
        "ide ite ate",
    ),
    (
        "sulfur nitr phosphor chlor brom iod selen chrom ferr cupr stann plumb mercur hypochlor "
        "perchlor hydrochlor hydrobrom hydroiod arsen tellur mangan permangan cobalt chlor aur",
        "ic ous",
    ),
    (
        "form acet propion butyr valer benz oxal malon succin glutar adip male fumar mal lact tart "
        "tartar citr stear palmit ole salicyl phthal laur glycol pyruv acryl carbon bicarbon "
        "gallic pic picr",
        "ic ate ate",
    ),
    ("mangan permangan manganes", "ate ic ous"),
    ("tolu xyl benz styr naphthal pyrid anil pyrrol quinol", "ene ine ole idine"),
    ("gluc fruct galact mann rib arabin xyl lact malt sucr cellul", "ose itol"),
    ("chlor brom iod fluor", "ine o obenzene oform omethane oethane"),
)
"""Words that are easily taken for each other: beginnings, and the endings that each may have."""

KIN = frozenset(_ELEMENTS.split()) | {
    start + end for starts, ends in _SERIES for start in starts.split() for end in ends.split()
}
"""Words of chemicals that a misspelt word may just as well have been."""


_OTHER_NAMES = """
abine acetoine acetoxy alacine anilino arine arpon batyl brominex brotane burine butanex carbazide
carbinom carbizol carbona cardinol carvon celestene celestone chlordane chopper cooper diazale
diazan diazene diron ethazol ethrane ethysene florane florite formarin fortalin gexane glutimic
glycemin glycerone glycon glyrol glytol haleite hectane hematine hexanes hydrogel hypro ibutane
indane ipron magnesio menthane menthyl menthylamine meocn mescn metam methazol methylacetate nabac
naphthacene natac natrin naturon navron nitex nitrek nitrex nitrofen nitron nitropen nutron octave
oxirane oxocane pentrane phenod phosphino phosphonous prenol prenyl prenylamine propanex propazone
prophene propiolic pyridione pyrodine rutine silicea silicom silvex stone sulfana suxar thfam
tichlor tiron titanio trilite tropane tropanone tropene
"""
"""Names of other chemicals and products that are one slip away from a word of the table.

Source: the names of all compounds in the package `chemicals` 1.5.2.
"""


_OTHERS = frozenset(_OTHER_NAMES.split())


def is_chemical(word: str) -> bool:
    """Whether a word is a chemical's, so that it is no misspelling of another."""
    return word in _OTHERS or made_of_parts(word)


@cache
def made_of_parts(word: str) -> bool:
    """Whether a word is parts of chemical names, one after another.

    Such a word is never taken for a misspelling of another: sodium sulfite is no slip of the pen
    for sodium sulfate. More words are made of parts than there are chemicals, on purpose.
    """
    if not word:
        return True
    starts = range(2, min(len(word), _LONGEST) + 1)
    return any(word[:end] in _PARTS and made_of_parts(word[end:]) for end in starts)
